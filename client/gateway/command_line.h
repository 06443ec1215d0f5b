// The command line of kcs-gateway.
#pragma once

#include <optional>
#include <string>

#include "client/gateway/playback.h"

namespace kcs::gateway {

struct CommandLine {
  std::string server;              // HOST:PORT
  std::string plan;                // "plans/…"; empty if a program is given
  std::string file;                // a G-code program; empty if a plan is given
  std::string machine = "router";  // a shipped profile's name, or a profile's file name
  client::PlanOptions planning;    // all but the machine
  PlaybackOptions playback;
  bool json = false;
};

// What was asked for in words: the help text, or what is wrong with the command line.
struct Message {
  std::string text;
  bool is_error = false;
};

// Reads the command line into `options`. Returns a message if there is nothing to run.
std::optional<Message> parse_command_line(int argc, const char* const* argv, CommandLine& options);

}  // namespace kcs::gateway
