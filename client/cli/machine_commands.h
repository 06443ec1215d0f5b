// What kcsctl's commands about machines and their runs do. They throw as run_command() says.
#pragma once

#include "client/cli/options.h"

namespace kcs::cli {

void list_machines(const Options& options);
// Plans the program first, unless the command line names a plan.
void run_plan(const Options& options);
// Hold, resume, abort, override.
void operate_run(const Options& options);
// Until it is over: throws client::Error if that is not its end. Or until the operator leaves.
void watch_run(const Options& options);

}  // namespace kcs::cli
