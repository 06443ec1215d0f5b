#include "server/observe/log.h"

#include <fmt/chrono.h>
#include <spdlog/spdlog.h>

#include <algorithm>

namespace kcs::observe {
namespace {

// As JSON in ASCII: control characters are escaped, and bytes that are not UTF-8 replaced.
std::string dump(const LogFields& value) { return value.dump(-1, ' ', true, LogFields::error_handler_t::replace); }

// Whether text can stand in a line of key=value without quotes.
bool is_plain(std::string_view text) {
  return !text.empty() && std::all_of(text.begin(), text.end(), [](char character) {
    return character > ' ' && character < '\x7f' && character != '"' && character != '=' && character != '\\';
  });
}

}  // namespace

void Log::write(spdlog::level::level_enum level, std::string_view message, const LogFields& fields) const {
  const std::shared_ptr<spdlog::logger> logger = logger_ != nullptr ? logger_ : spdlog::default_logger();
  if (!logger->should_log(level)) return;
  logger->log(level, format_ == LogFormat::kText ? text_line(message, fields)
                                                 : json_line(std::chrono::system_clock::now(), level, message, fields));
}

std::string text_line(std::string_view message, const LogFields& fields) {
  std::string line(message);
  for (const auto& [key, value] : fields.items()) {
    const auto* text = value.get_ptr<const std::string*>();
    line += ' ' + key + '=' + (text != nullptr && is_plain(*text) ? *text : dump(value));
  }
  return line;
}

std::string json_line(std::chrono::system_clock::time_point time, spdlog::level::level_enum level,
                      std::string_view message, const LogFields& fields) {
  using std::chrono::milliseconds;
  const auto since = std::chrono::duration_cast<milliseconds>(time.time_since_epoch());
  const spdlog::string_view_t name = spdlog::level::to_string_view(level);
  LogFields line = {{"time", fmt::format("{:%Y-%m-%dT%H:%M:%S}.{:03}Z", fmt::gmtime(time),
                                         since.count() % milliseconds::period::den)},
                    {"level", std::string(name.data(), name.size())},
                    {"message", message}};
  for (const auto& [key, value] : fields.items()) line[key] = value;
  return dump(line);
}

}  // namespace kcs::observe
