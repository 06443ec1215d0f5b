// The keys of the table [store].
#pragma once

#include "server/service/settings_file.h"
#include "server/store/settings.h"

namespace kcs::service {

Keys store_keys(store::StoreSettings& settings);

}  // namespace kcs::service
