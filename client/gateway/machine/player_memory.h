// The memory that gateway and player share.
#pragma once

#include <memory>
#include <string>

#include "client/gateway/player/player.h"

namespace kcs::gateway {

// Gives the memory back, whatever it came from, when the last owner is gone.
using PlayerMemory = std::shared_ptr<kcs_player_memory>;

// For a player in this process.
PlayerMemory make_player_memory(const kcs_player_profile& profile);

// That of the LinuxCNC component called `name`: the POSIX shared memory "/kcs-NAME", which it makes when it is loaded.
// Held for this process alone. Throws client::FileError if it is not there, does not tick yet, is of another version,
// or is held by another gateway.
PlayerMemory open_player_memory(const std::string& name);

}  // namespace kcs::gateway
