// A motion, as a sequence of constant-jerk phases. Sampling, verification and plots read this type and need not know
// how it was made.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <iterator>
#include <optional>
#include <vector>

#include "server/motion/phase.h"
#include "server/motion/phase_code.h"

namespace kcs::motion {

// Keeps its phases packed, about 20 to 45 bytes each; what is read is bit for bit what was appended. A plan of hours
// has millions of them.
// Phases are appended first; then many threads may read at once.
class Trajectory {
  struct Block;

 public:
  class Iterator;

  // Goes on with `phase`. A motion has no gaps: each phase starts when and where the one before it ends (the verifier
  // checks it).
  void append(const Phase& phase);

  // Says where and how the motion ends, exactly: its last setpoint.
  void set_final_state(const State& state) { final_state_ = state; }
  const State& final_state() const { return final_state_; }

  bool empty() const { return size_ == 0; }
  std::size_t size() const { return size_; }                                 // number of phases
  double duration() const { return last_ ? last_->phase().end_time() : 0; }  // s
  std::size_t bytes() const;                                                 // of memory

  // The phases in order of time: for (const Phase& phase : trajectory). A phase is gone when the iterator moves on.
  Iterator begin() const;
  std::default_sentinel_t end() const { return {}; }

 private:
  // Some phases: the first one as it is, the others packed.
  struct Block {
    Phase first;
    std::uint32_t others = 0;
    std::vector<std::byte> packed = std::vector<std::byte>(PhaseCode::kPadding);
  };

  std::deque<Block> blocks_;
  std::optional<PhaseCode> last_;
  std::size_t size_ = 0;
  State final_state_;
};

// Where a reader is in a trajectory, which must outlive it and not change meanwhile.
class Trajectory::Iterator {
 public:
  const Phase& operator*() const { return code_.phase(); }
  const Phase* operator->() const { return &code_.phase(); }

  Iterator& operator++();
  bool operator==(std::default_sentinel_t) const { return block_ == trajectory_->blocks_.size(); }

  // Goes to the phase at `time` (s): the last one that has started by then, or the first one. Logarithmic in the number
  // of phases, constant from one phase to the next.
  void seek(double time);

 private:
  friend class Trajectory;
  Iterator(const Trajectory& trajectory, std::size_t block);
  void enter(std::size_t block);

  const Trajectory* trajectory_;
  std::size_t block_;
  std::uint32_t left_ = 0;  // phases of the block that were not read yet
  const std::byte* next_ = nullptr;
  PhaseCode code_;
};

}  // namespace kcs::motion
