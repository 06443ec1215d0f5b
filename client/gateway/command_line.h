// The command line of kcs-gateway.
#pragma once

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
};

// Reads the command line into `options`. Returns a message if there is nothing to run.
std::optional<client::Message> parse_command_line(int argc, const char* const* argv, CommandLine& options);

}  // namespace kcs::gateway
