// Whether a batch came as it was sent.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

#include "kcs/v1/machine.pb.h"

namespace kcs::gateway {

// What MotionBatch.checksum must be.
std::uint32_t checksum_of(const v1::MotionBatch& batch);

// What is wrong with a batch by itself, whatever came before it: a checksum that does not match, columns that are not
// one per axis or of different lengths, more than the player has room for, something that is no number. Nothing: it is
// sound. Whether its motion keeps the machine's limits is for the player to see.
std::optional<std::string> find_damage(const v1::MotionBatch& batch, std::size_t axes);

}  // namespace kcs::gateway
