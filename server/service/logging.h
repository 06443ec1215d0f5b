// Where the log goes.
#pragma once

#include <spdlog/common.h>

namespace kcs::service {

// Sends the log to the standard error, one line an entry, and what gRPC has to say with it.
void set_up_logging(spdlog::level::level_enum level);

}  // namespace kcs::service
