// Phases in few bytes, bit for bit.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "server/motion/phase.h"

namespace kcs::motion {

// Writes and reads a sequence of phases, each by what the one before it does not tell: the state where it ends but for
// some last bits, often the duration, sometimes the jerk. A phase of three axes takes about 40 bytes instead of 120, a
// straight one about 20; every number comes back exactly, whatever it is.
// One object goes through one sequence, either writing or reading.
class PhaseCode {
 public:
  // What is read may be looked at up to here beyond its end.
  static constexpr std::size_t kPadding = 8;  // bytes

  explicit PhaseCode(const Phase& first) : phase_(first), jerk_(first.jerk) {}

  // The last phase that was written or read.
  const Phase& phase() const { return phase_; }

  // Only a phase that starts when the last one ends can be written.
  bool can_write(const Phase& next) const {
    return std::bit_cast<std::uint64_t>(next.start_time) == std::bit_cast<std::uint64_t>(phase_.end_time());
  }

  // Appends the next phase; can_write(next).
  void write(const Phase& next, std::vector<std::byte>& bytes);

  // Reads the next phase. Returns where the one after it begins.
  const std::byte* read(const std::byte* bytes);

 private:
  Phase phase_;
  Vector jerk_;  // each axis' last one that was not zero, mm/s³
};

}  // namespace kcs::motion
