#include "server/motion/place_sampler.h"

#include <algorithm>

#include "server/motion/setpoint.h"

namespace kcs::motion {

PlaceSampler::PlaceSampler(const Trajectory& trajectory, const Path& path, const std::vector<Milestone>& milestones,
                           double period)
    : path_(path),
      milestones_(milestones),
      period_(period),
      count_(setpoint_count(trajectory.duration(), period)),
      phase_(trajectory.begin()) {}

Place PlaceSampler::at(std::uint64_t index) {
  if (index + 1 >= count_ || milestones_.empty()) return path_.end();
  const double time = setpoint_time(index, period_);
  go_to(time);
  return progress_->at(std::min(time - phase_->start_time, phase_->duration));
}

void PlaceSampler::go_to(double time) {
  if (!progress_ || time < phase_->start_time || (next_ < milestones_.size() && time >= milestones_[next_].time)) {
    const auto after = std::upper_bound(milestones_.begin() + 1, milestones_.end(), time,
                                        [](double t, const Milestone& milestone) { return t < milestone.time; });
    next_ = static_cast<std::size_t>(after - milestones_.begin());
    phase_.seek(milestones_[next_ - 1].time);
    progress_.emplace(path_, milestones_[next_ - 1].place);
    progress_->follow(*phase_);
  }
  while (time >= phase_->end_time()) progress_->follow(*++phase_);
}

}  // namespace kcs::motion
