#include "server/service/logging.h"

#include <grpc/support/log.h>
#include <spdlog/formatter.h>
#include <spdlog/pattern_formatter.h>
#include <spdlog/sinks/stdout_sinks.h>
#include <spdlog/spdlog.h>

#include <memory>
#include <string>
#include <string_view>
#include <utility>

namespace kcs::service {
namespace {

// Makes a JSON object of a message without fields.
class JsonFormatter final : public spdlog::formatter {
 public:
  void format(const spdlog::details::log_msg& message, spdlog::memory_buf_t& line) override {
    const std::string_view text(message.payload.data(), message.payload.size());
    const std::string json = observe::json_line(message.time, message.level, text, {});
    line.append(json.data(), json.data() + json.size());
    line.push_back('\n');
  }
  std::unique_ptr<spdlog::formatter> clone() const override { return std::make_unique<JsonFormatter>(); }
};

std::shared_ptr<spdlog::logger> make_logger(spdlog::level::level_enum level,
                                            std::unique_ptr<spdlog::formatter> formatter) {
  auto logger = std::make_shared<spdlog::logger>("kcsd", std::make_shared<spdlog::sinks::stderr_sink_mt>());
  logger->set_formatter(std::move(formatter));
  logger->set_level(level);
  logger->flush_on(spdlog::level::trace);
  return logger;
}

std::unique_ptr<spdlog::formatter> pattern(const char* text) {
  return std::make_unique<spdlog::pattern_formatter>(text);
}

void log_for_grpc(gpr_log_func_args* entry) {
  // Its errors are mostly about what some client did.
  spdlog::log(entry->severity == GPR_LOG_SEVERITY_ERROR ? spdlog::level::warn : spdlog::level::debug, "gRPC: {}",
              entry->message);
}

}  // namespace

observe::Log set_up_logging(spdlog::level::level_enum level, observe::LogFormat format) {
  gpr_set_log_function(log_for_grpc);
  if (format == observe::LogFormat::kText) {
    const auto logger = make_logger(level, pattern("%Y-%m-%dT%H:%M:%S.%e%z %l %v"));
    spdlog::set_default_logger(logger);
    return {logger, format};
  }
  spdlog::set_default_logger(make_logger(level, std::make_unique<JsonFormatter>()));
  return {make_logger(level, pattern("%v")), format};
}

}  // namespace kcs::service
