// What the player says, in the words of the contract.
#pragma once

#include <cstdint>
#include <string_view>

#include "kcs/v1/machine.pb.h"

namespace kcs::gateway {

// state: enum kcs_player_state.
v1::MachineState to_message(std::uint32_t state);
std::string_view name_of(v1::MachineState state);  // "RUNNING"

// Why it stopped, for the operator; reason: enum kcs_player_reason.
std::string_view describe_reason(std::uint32_t reason);

}  // namespace kcs::gateway
