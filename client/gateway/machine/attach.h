// `kcs-gateway attach`: beside a machine, from its start to its stop.
#pragma once

#include <filesystem>
#include <optional>

#include "client/common/exit_code.h"
#include "client/gateway/machine/settings.h"

namespace kcs::gateway {

// Feeds the machine until SIGTERM or SIGINT, then brings it to rest. `record`: where to write every tick's commanded
// and actual positions (see Recording), with the simulated driver alone. Throws client::Error, client::FileError or
// std::system_error if it cannot begin, if the player ticks no more, or if the recording cannot be written to its end.
client::ExitCode attach(const Settings& settings, const std::optional<std::filesystem::path>& record);

}  // namespace kcs::gateway
