// Setpoints of a motion while it is still being made.
#pragma once

#include <cstdint>
#include <deque>
#include <optional>

#include "server/motion/setpoint.h"

namespace kcs::motion {

// Gives the setpoints that Sampler gives of the whole trajectory, bit for bit, each as soon as it is certain: it is not
// if the motion might end so soon that the exact end takes its place. Memory: constant, as long as the setpoints are
// taken before the next phase is added.
class LiveSampler {
 public:
  // period: s, > 0.
  explicit LiveSampler(double period) : period_(period) {}

  // The next phase; it starts exactly when the one before it ends.
  void add(const Phase& phase);

  // The motion has ended, in this state.
  void finish(const State& final_state) { final_state_ = final_state; }

  // The next setpoint; none if it is not certain yet, or if the last one was given.
  std::optional<Setpoint> next();

  // How many setpoints were given.
  std::uint64_t given() const { return given_; }
  // Whether the last of them was the end of the motion.
  bool ended() const { return ended_; }

 private:
  double period_;
  std::deque<Phase> phases_;  // that setpoints may still fall into
  std::uint64_t count_ = 1;   // of setpoints, if that were all
  std::uint64_t given_ = 0;
  std::optional<State> final_state_;
  bool ended_ = false;
};

}  // namespace kcs::motion
