// Forgets what is old or too much.
#pragma once

#include <string>
#include <vector>

#include "server/store/connections.h"
#include "server/store/settings.h"

namespace kcs::store {

// See Store::sweep().
std::vector<std::string> sweep(Connections& connections, const StoreSettings& settings);

}  // namespace kcs::store
