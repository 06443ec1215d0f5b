// The settings of kcsd.
#pragma once

#include <spdlog/common.h>

#include <chrono>
#include <string>

#include "server/service/server.h"

namespace kcs::service {

struct Config {
  ServerOptions server;
  // How long running requests may go on once the server is told to stop.
  std::chrono::milliseconds grace = std::chrono::seconds(10);
  spdlog::level::level_enum log_level = spdlog::level::info;
};

// Reads a configuration file (deploy/kcsd.toml shows all there is). What it does not mention keeps its default.
// Throws std::runtime_error that starts with "FILE:LINE:" and says what is wrong and what is allowed.
Config load_config(const std::string& file);

// Throws std::runtime_error that names the levels.
spdlog::level::level_enum parse_log_level(const std::string& name);

}  // namespace kcs::service
