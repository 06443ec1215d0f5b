// What a motion is made of: pieces of constant jerk.
#pragma once

#include <Eigen/Core>
#include <cstdint>

namespace kcs::motion {

// One number per axis: X, Y, Z. A machine with two axes leaves Z at zero.
using Vector = Eigen::Vector3d;

// Where the tool is and how it moves, at one instant.
struct State {
  Vector position = Vector::Zero();      // mm
  Vector velocity = Vector::Zero();      // mm/s
  Vector acceleration = Vector::Zero();  // mm/s²
};

// A range of segments of a tool path, both ends included, counted from 0.
struct SegmentRange {
  std::uint32_t first = 0;
  std::uint32_t last = 0;
};

// A stretch of time during which the jerk of every axis is constant (so each position is a cubic of time).
// It carries its own start state: a long trajectory does not gather rounding errors.
struct Phase {
  double start_time = 0;  // s since the start of the trajectory
  double duration = 0;    // s, > 0
  State start;
  Vector jerk = Vector::Zero();  // mm/s³
  // The segments that the tool follows meanwhile: one leg's, or those of both legs at a corner.
  SegmentRange segments;

  // The state `time` seconds after the start of the phase; 0 ≤ time ≤ duration.
  State at(double time) const {
    const double half_square = time * time / 2;
    return {start.position + time * start.velocity + half_square * start.acceleration + (half_square * time / 3) * jerk,
            start.velocity + time * start.acceleration + half_square * jerk, start.acceleration + time * jerk};
  }

  double end_time() const { return start_time + duration; }

  // Nothing moves meanwhile: a dwell.
  bool rests() const { return start.velocity.isZero(0) && start.acceleration.isZero(0) && jerk.isZero(0); }
};

}  // namespace kcs::motion
