#include "client/common/command_line.h"

#include <CLI/CLI.hpp>
#include <iostream>
#include <sstream>

#include "client/common/exit_code.h"

namespace kcs::client {

std::optional<Message> parse(CLI::App& app, int argc, const char* const* argv) {
  try {
    app.parse(argc, argv);
    return std::nullopt;
  } catch (const CLI::ParseError& error) {
    std::ostringstream out;
    std::ostringstream problems;
    const bool is_error = app.exit(error, out, problems) != 0;
    return Message{is_error ? app.get_name() + ": " + problems.str() : out.str(), is_error};
  }
}

int print(const Message& message) {
  (message.is_error ? std::cerr : std::cout) << message.text;
  return message.is_error ? kUsage : kDone;
}

}  // namespace kcs::client
