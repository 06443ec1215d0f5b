#include "server/service/logging.h"

#include <grpc/support/log.h>
#include <spdlog/sinks/stdout_sinks.h>
#include <spdlog/spdlog.h>

#include <memory>

namespace kcs::service {
namespace {

void log_for_grpc(gpr_log_func_args* entry) {
  // Its errors are mostly about what some client did.
  spdlog::log(entry->severity == GPR_LOG_SEVERITY_ERROR ? spdlog::level::warn : spdlog::level::debug, "gRPC: {}",
              entry->message);
}

}  // namespace

void set_up_logging(spdlog::level::level_enum level) {
  const auto logger = std::make_shared<spdlog::logger>("kcsd", std::make_shared<spdlog::sinks::stderr_sink_mt>());
  logger->set_pattern("%Y-%m-%dT%H:%M:%S.%e%z %l %v");
  logger->set_level(level);
  logger->flush_on(spdlog::level::trace);
  spdlog::set_default_logger(logger);
  gpr_set_log_function(log_for_grpc);
}

}  // namespace kcs::service
