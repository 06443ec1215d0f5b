// From a command line to options, with what there is to say on the way.
#pragma once

#include <optional>
#include <string>

namespace CLI {
class App;
}

namespace kcs::client {

// What was asked for in words: the help text, or what is wrong with the command line.
struct Message {
  std::string text;
  bool is_error = false;
};

// Lets `app` read the command line. Returns a message if there is nothing to run.
std::optional<Message> parse(CLI::App& app, int argc, const char* const* argv);

// Prints a message where it belongs. Returns the program's exit code.
int print(const Message& message);

}  // namespace kcs::client
