// The log of a server under test.
#pragma once

#include <spdlog/sinks/ringbuffer_sink.h>

#include <memory>
#include <string>
#include <vector>

#include "server/observe/log.h"

namespace kcs::service::test {

// Keeps the latest lines of a log, as JSON.
class LogLines {
 public:
  LogLines() {
    logger_->set_pattern("%v");
    logger_->set_level(spdlog::level::debug);
  }

  observe::Log log() const { return {logger_, observe::LogFormat::kJson}; }

  // Those with this field, parsed.
  std::vector<observe::LogFields> with(const std::string& field, const std::string& value) const {
    std::vector<observe::LogFields> found;
    for (const std::string& line : sink_->last_formatted()) {
      auto fields = observe::LogFields::parse(line);
      if (fields.value(field, "") == value) found.push_back(std::move(fields));
    }
    return found;
  }

 private:
  static constexpr std::size_t kMost = 1000;

  std::shared_ptr<spdlog::sinks::ringbuffer_sink_mt> sink_ = std::make_shared<spdlog::sinks::ringbuffer_sink_mt>(kMost);
  std::shared_ptr<spdlog::logger> logger_ = std::make_shared<spdlog::logger>("test", sink_);
};

}  // namespace kcs::service::test
