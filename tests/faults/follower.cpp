#include "tests/faults/follower.h"

#include <algorithm>

namespace kcs::faults {
namespace {

constexpr double kSame = 1e-9;  // mm: recordings have 15 digits
constexpr double kFastest = 3;  // times the planned pace: no override allows more
constexpr int kThirds = 60, kLooks = 16;

}  // namespace

motion::Vector Follower::at(double time) {
  if (time < phase_->start_time || time >= phase_->end_time()) phase_.seek(time);
  return phase_->at(std::clamp(time - phase_->start_time, 0.0, phase_->duration)).position;
}

double Follower::follow(const motion::Vector& command) {
  const double end = plan_.trajectory.duration();
  const double planned = std::min(time_ + period_, end), latest = std::min(time_ + kFastest * period_, end);
  double best = time_, least = distance(time_, command);
  const double at_planned_pace = distance(planned, command);
  as_planned_ = at_planned_pace < least && at_planned_pace <= kSame;
  if (as_planned_) {
    time_ = planned;
    return at_planned_pace;
  }
  if (least <= kSame) return least;  // it stands
  for (int i = 1; i <= kLooks; ++i) {
    const double time = time_ + (latest - time_) * i / kLooks;
    const double there = distance(time, command);
    if (there >= least) continue;
    least = there;
    best = time;
  }
  const double step = (latest - time_) / kLooks;
  double low = std::max(time_, best - step), high = std::min(latest, best + step);
  for (int i = 0; i < kThirds; ++i) {
    const double third = (high - low) / 3;
    if (distance(low + third, command) < distance(high - third, command)) {
      high -= third;
    } else {
      low += third;
    }
  }
  time_ = (low + high) / 2;
  return distance(time_, command);
}

}  // namespace kcs::faults
