// The simplest plan there is, with stop tails: straight ahead from rest to rest.
#pragma once

#include <cstdint>
#include <string>

#include "client/gateway/player/player.h"
#include "client/gateway/vector.h"
#include "kcs/v1/machine.pb.h"
#include "tests/line_motion/line_motion.h"

namespace kcs::gateway {

// The machine of these tests: two axes.
kcs_player_profile test_profile(double period_s = 0.001);

// A plan whose clock is its way: at plan time s the tool is at point(s), s mm from the start. Played from rest at any
// plan time to its end, at limits of 100 mm/s, 1000 mm/s² and 20000 mm/s³ along the path.
class StraightMotion {
 public:
  static Vector point(double way_mm) { return {0.8 * way_mm, 0.6 * way_mm, 0}; }

  // axes: 2, or 3, of which the third one stands.
  StraightMotion(double from_mm, double to_mm, double period_s, int axes = 2);

  // Setpoints to the end; the first one is a period after the rest.
  std::uint64_t size() const { return size_; }

  // Setpoints [first, first + count), as ticks `first_tick`… of the run, with their stop tail.
  v1::MotionBatch batch(const std::string& run, std::uint64_t branch, std::uint64_t first_tick, std::uint64_t first,
                        std::uint64_t count) const;

 private:
  test::LineState at(std::uint64_t setpoint) const;

  double to_;
  double period_;
  int axes_;
  test::LineMotion motion_;
  std::uint64_t size_;
};

}  // namespace kcs::gateway
