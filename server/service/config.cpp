#include "server/service/config.h"

#include <spdlog/fmt/fmt.h>
#include <spdlog/fmt/ranges.h>
#include <toml++/toml.h>

#include <cmath>
#include <cstdint>
#include <functional>
#include <map>
#include <stdexcept>
#include <string_view>
#include <vector>

namespace kcs::service {
namespace {

// What to do with the value of each key of a table.
using Keys = std::map<std::string, std::function<void(const toml::node&)>, std::less<>>;

[[noreturn]] void refuse(const toml::source_region& where, const std::string& what) {
  throw std::runtime_error(fmt::format("{}:{}: {}", where.path ? *where.path : "", where.begin.line, what));
}

void read_table(const toml::table& table, const std::string& name, const Keys& keys) {
  for (const auto& [key, value] : table) {
    const auto known = keys.find(key.str());
    if (known == keys.end()) {
      std::vector<std::string> names;
      for (const auto& entry : keys) names.push_back(entry.first);
      refuse(key.source(), fmt::format("unknown key \"{}\" {}; known are {}", key.str(), name, fmt::join(names, ", ")));
    }
    known->second(value);
  }
}

std::function<void(const toml::node&)> table_of(const std::string& name, Keys keys) {
  return [name, keys = std::move(keys)](const toml::node& node) {
    if (!node.is_table()) refuse(node.source(), name + " must be a table");
    read_table(*node.as_table(), "in [" + name + "]", keys);
  };
}

// A whole number from `low` to `high`.
template <typename Integer>
std::function<void(const toml::node&)> whole(Integer& target, std::int64_t low, std::int64_t high) {
  return [&target, low, high](const toml::node& node) {
    const auto value = node.value_exact<std::int64_t>();
    if (!value || *value < low || *value > high) {
      refuse(node.source(), fmt::format("must be a whole number from {} to {}", low, high));
    }
    target = static_cast<Integer>(*value);
  };
}

std::string text(const toml::node& node) {
  const auto value = node.value_exact<std::string>();
  if (!value) refuse(node.source(), "must be a string");
  return *value;
}

Keys cap_keys(Caps& caps) {
  constexpr std::int64_t kMany = 1'000'000'000'000;
  constexpr std::int64_t kMostCalls = 10'000;  // each may take a thread
  constexpr std::int64_t kMostMessage = 1 << 30;
  return {{"points_per_plan", whole(caps.points_per_plan, 2, kMany)},
          {"gcode_bytes", whole(caps.gcode_bytes, 1, kMany)},
          {"message_bytes", whole(caps.message_bytes, 1024, kMostMessage)},
          {"stored_plans", whole(caps.stored_plans, 1, kMany)},
          {"stored_bytes", whole(caps.stored_bytes, 1, kMany)},
          {"queue_length", whole(caps.queue_length, 0, kMany)},
          {"uploads", whole(caps.uploads, 1, kMostCalls)},
          {"streams", whole(caps.streams, 1, kMostCalls)},
          {"live_streams", whole(caps.live_streams, 1, kMostCalls)}};
}

Keys server_keys(Config& config) {
  constexpr std::int64_t kMostThreads = 1024;
  return {{"listen", [&config](const toml::node& node) { config.server.listen = text(node); }},
          {"threads", whole(config.server.planning_threads, 0, kMostThreads)},
          {"grace_s",
           [&config](const toml::node& node) {
             constexpr double kMostGrace = 3600;
             const auto seconds = node.value<double>();
             if (!seconds || !(*seconds >= 0 && *seconds <= kMostGrace)) {
               refuse(node.source(), fmt::format("must be a number of seconds from 0 to {}", kMostGrace));
             }
             config.grace = std::chrono::milliseconds(std::llround(*seconds * 1000));
           }},
          {"log_level", [&config](const toml::node& node) {
             try {
               config.log_level = parse_log_level(text(node));
             } catch (const std::runtime_error& unknown) {
               refuse(node.source(), unknown.what());
             }
           }}};
}

}  // namespace

Config load_config(const std::string& file) {
  Config config;
  toml::table root;
  try {
    root = toml::parse_file(file);
  } catch (const toml::parse_error& error) {
    if (error.source().begin.line == 0) throw std::runtime_error(file + ": " + std::string(error.description()));
    refuse(error.source(), std::string(error.description()));
  }
  read_table(
      root, "at the top level",
      {{"server", table_of("server", server_keys(config))}, {"caps", table_of("caps", cap_keys(config.server.caps))}});
  return config;
}

spdlog::level::level_enum parse_log_level(const std::string& name) {
  static const std::map<std::string, spdlog::level::level_enum, std::less<>> kLevels = {
      {"debug", spdlog::level::debug},
      {"info", spdlog::level::info},
      {"warning", spdlog::level::warn},
      {"error", spdlog::level::err},
      {"off", spdlog::level::off}};
  const auto level = kLevels.find(name);
  if (level == kLevels.end()) {
    throw std::runtime_error("\"" + name + "\" is no log level: use debug, info, warning, error or off");
  }
  return level->second;
}

}  // namespace kcs::service
