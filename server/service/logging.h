// Where the log goes.
#pragma once

#include <spdlog/common.h>

#include "server/observe/log.h"

namespace kcs::service {

// Sends the log to the standard error, one line an entry: what is written to the log that is returned and to spdlog's
// default logger, and what gRPC has to say.
observe::Log set_up_logging(spdlog::level::level_enum level, observe::LogFormat format);

}  // namespace kcs::service
