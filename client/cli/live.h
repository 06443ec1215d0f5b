// kcsctl live: plans a program while it comes.
#pragma once

#include <iosfwd>

#include "client/cli/options.h"
#include "client/sdk/plan.h"

namespace kcs::cli {

// Plans the program of the command line, and writes its setpoints to `out` (none: nowhere) as they come. Memory: the
// same for every length of the program. Throws client::ProfileError, client::Error and client::FileError.
client::Plan plan_live(const Options& options, std::ostream* out);

}  // namespace kcs::cli
