// The part of the command line that is about machines and their runs.
#pragma once

#include "client/cli/options.h"

namespace CLI {
class App;
}

namespace kcs::cli {

// Adds these commands. What they say goes to `options`, which must live until `app` has read the command line.
void add_machine_commands(CLI::App& app, Options& options);

}  // namespace kcs::cli
