// What kcsctl's commands do.
#pragma once

#include "client/cli/options.h"

namespace kcs::cli {

// Runs the command of the command line. Results go to standard output or to the file named there; what goes wrong is
// thrown: client::Error, client::ProfileError, client::FileError.
void run_command(const Options& options);

}  // namespace kcs::cli
