#include "tests/bench/stutter/speed_samples.h"

#include "server/motion/sampler.h"
#include "tests/bench/path_follower.h"

namespace kcs::bench {

std::vector<SpeedSample> speed_samples(const motion::Trajectory& trajectory, const planning::Toolpath& path,
                                       double tolerance) {
  constexpr double kPeriod = 0.0001;  // s: 10 µm at 100 mm/s
  motion::Sampler sampler(trajectory, kPeriod);
  PathFollower follower(path, tolerance);
  std::vector<SpeedSample> samples;
  samples.reserve(sampler.count());
  for (std::uint64_t i = 0; i < sampler.count(); ++i) {
    const motion::State state = sampler.at(i).state;
    const PathFollower::Place place = follower.follow(state.position);
    samples.push_back({place.length, state.velocity.norm(), place.segment});
  }
  return samples;
}

}  // namespace kcs::bench
