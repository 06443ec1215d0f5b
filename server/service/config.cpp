#include "server/service/config.h"

#include <cstdint>
#include <map>
#include <stdexcept>

#include "server/service/connection_settings.h"
#include "server/service/security_settings.h"
#include "server/service/settings_file.h"
#include "server/service/store_settings.h"

namespace kcs::service {
namespace {

Keys cap_keys(Caps& caps) {
  constexpr std::int64_t kMany = 1'000'000'000'000;
  constexpr std::int64_t kMostCalls = 10'000;  // each may take a thread
  constexpr std::int64_t kMostMessage = 1 << 30;
  constexpr std::int64_t kMostHttpPlans = 1'000;
  // What goes into the store in one piece, of a GiB.
  constexpr std::int64_t kMostPoints = 20'000'000;
  constexpr std::int64_t kMostGcode = 1 << 30;
  return {{"points_per_plan", whole(caps.points_per_plan, 2, kMostPoints)},
          {"gcode_bytes", whole(caps.gcode_bytes, 1, kMostGcode)},
          {"message_bytes", whole(caps.message_bytes, 1024, kMostMessage)},
          {"cached_plans", whole(caps.cached_plans, 1, kMany)},
          {"cached_bytes", whole(caps.cached_bytes, 1, kMany)},
          {"queue_length", whole(caps.queue_length, 0, kMany)},
          {"client_waiting", whole(caps.client_waiting, 0, kMany)},
          {"client_running", whole(caps.client_running, 0, kMany)},
          {"uploads", whole(caps.uploads, 1, kMostCalls)},
          {"client_uploads", whole(caps.client_uploads, 1, kMostCalls)},
          {"streams", whole(caps.streams, 1, kMostCalls)},
          {"client_streams", whole(caps.client_streams, 1, kMostCalls)},
          {"live_streams", whole(caps.live_streams, 1, kMostCalls)},
          {"client_live_streams", whole(caps.client_live_streams, 1, kMostCalls)},
          {"look_ahead", whole(caps.look_ahead, 1, kMany)},
          {"http_plans", whole(caps.http_plans, 1, kMostHttpPlans)},
          {"machines", whole(caps.machines, 1, kMostCalls)}};
}

Keys server_keys(Config& config) {
  constexpr std::int64_t kMostThreads = 1024;
  constexpr double kMostGrace = 3600;
  return {{"listen", text(config.server.listen)},
          {"threads", whole(config.server.planning_threads, 0, kMostThreads)},
          {"grace_s", seconds(config.grace, 0, kMostGrace)},
          {"log_level", parsed([&config](const std::string& name) { config.log_level = parse_log_level(name); })}};
}

}  // namespace

Config load_config(const std::string& file) {
  Config config;
  Keys tables = {{"caps", table_of("caps", cap_keys(config.server.caps))},
                 {"connections", table_of("connections", connection_keys(config.server.connections))},
                 {"observe", table_of("observe", observe_keys(config.server.observe))},
                 {"server", table_of("server", server_keys(config))},
                 {"store", table_of("store", store_keys(config.server.store))}};
  tables.merge(security_tables(config.server.security));
  read_tables(file, tables);
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
