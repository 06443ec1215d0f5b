// Log lines with fields, as text or as JSON.
#pragma once

#include <spdlog/logger.h>

#include <chrono>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <utility>

namespace kcs::observe {

enum class LogFormat {
  kText,  // the fields follow the message as key=value
  kJson   // one JSON object a line: time (RFC 3339, UTC), level, message, then the fields
};

// The fields of a line: a JSON object, in the order in which they were added.
using LogFields = nlohmann::ordered_json;

// Writes lines with fields. Copies write to the same place. Safe for use by many threads at once.
class Log {
 public:
  // Text, to what is spdlog's default logger whenever it writes.
  Log() = default;
  // logger: writes what it is given and a line's end; as text with the time and the level before it, as JSON bare.
  Log(std::shared_ptr<spdlog::logger> logger, LogFormat format) : logger_(std::move(logger)), format_(format) {}

  // message: one line. The fields may hold anything: what would break a line is escaped.
  void write(spdlog::level::level_enum level, std::string_view message, const LogFields& fields) const;

 private:
  std::shared_ptr<spdlog::logger> logger_;  // null for spdlog's default one
  LogFormat format_ = LogFormat::kText;
};

// A line of the log without its end.
std::string text_line(std::string_view message, const LogFields& fields);
std::string json_line(std::chrono::system_clock::time_point time, spdlog::level::level_enum level,
                      std::string_view message, const LogFields& fields);

}  // namespace kcs::observe
