// How far the machine's motion is from the path that it was told to follow.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "client/gateway/vector.h"

namespace kcs::gateway {

// What a motion's contour errors come to.
struct ContourFigures {
  double rms_mm = 0;
  double max_mm = 0;
  std::uint64_t max_index = 0;              // tick at which it was largest, from 0
  Vector max_position_mm = Vector::Zero();  // where the machine was then
};

// Measures the contour error of each tick: the distance from the actual position to the nearest point of the commanded
// path, which is the straight lines between the commanded setpoints, from `window` ticks before to `window` ticks
// after. So a mere lag along the path counts as nothing, which is what tells contour error from following error. The
// window keeps the nearest point on the pass that the tool is making, where a path crosses or repeats itself. The
// reference is the smoothed path that was commanded, not the sharp-cornered one that was programmed: what is measured
// is the machine, not the tolerance. Looking ahead means that the error of a tick is known `window` ticks later; memory
// is bounded by the window.
class ContourError {
 public:
  // window: ticks on either side, at least 1.
  explicit ContourError(std::size_t window);

  // The next tick: where the machine should have been and where it was, mm.
  void add(const Vector& commanded_mm, const Vector& actual_mm);

  // Measures the ticks still waiting for what comes after them; call once, after the last tick.
  ContourFigures finish();

 private:
  void measure(std::uint64_t tick);
  double distance_to_path(const Vector& actual, std::uint64_t tick) const;
  const Vector& commanded(std::uint64_t tick) const { return commanded_[tick % commanded_.size()]; }

  std::size_t window_;
  std::vector<Vector> commanded_;  // rings: tick i is at i modulo the size
  std::vector<Vector> actual_;
  std::uint64_t added_ = 0;     // ticks
  std::uint64_t measured_ = 0;  // ticks
  double sum_of_squares_ = 0;   // mm²
  ContourFigures figures_;
};

}  // namespace kcs::gateway
