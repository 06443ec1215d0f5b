// The command line of kcs-gateway.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "client/common/command_line.h"
#include "client/common/planning_options.h"
#include "client/gateway/playback.h"
#include "client/sdk/connection.h"

namespace kcs::gateway {

struct CommandLine {
  client::Connection server;
  std::string plan;  // "plans/…"; empty if a program is given
  std::string file;  // a G-code program; empty if a plan is given
  std::string machine = client::kDefaultMachine;
  client::PlanOptions planning;  // all but the machine
  PlaybackOptions playback;
  bool json = false;

  // `attach` instead of all that: the file that says how, what the command line says about the server instead of it
  // (empty address: nothing), and where to write every tick.
  std::optional<std::filesystem::path> attach;
  client::Connection attach_server;
  std::optional<std::filesystem::path> attach_record;
};

// Reads the command line into `options`. Returns a message if there is nothing to run.
std::optional<client::Message> parse_command_line(int argc, const char* const* argv, CommandLine& options);

}  // namespace kcs::gateway
