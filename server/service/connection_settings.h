// The table [connections] of the configuration.
#pragma once

#include "server/service/connections.h"
#include "server/service/settings_file.h"

namespace kcs::service {

Keys connection_keys(ConnectionSettings& settings);

}  // namespace kcs::service
