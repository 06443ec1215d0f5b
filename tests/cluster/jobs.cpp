#include "tests/cluster/jobs.h"

#include <random>

namespace kcs::test {

client::PointPath corners(std::uint64_t seed, int segments, double longest) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> step(-longest, longest);
  client::PointPath path;
  double x = 0, y = 0;
  for (int i = 0; i <= segments; ++i) {
    path.points_mm.insert(path.points_mm.end(), {x, y});
    x += step(random);
    y += step(random);
  }
  return path;
}

client::PlanOptions job_options() {
  client::PlanOptions options;
  options.machine.axes = 2;
  options.machine.velocity_mm_s = {500, 500};
  options.machine.acceleration_mm_s2 = {2500, 2500};
  options.machine.jerk_mm_s3 = {2e5, 2e5};
  options.feed_mm_s = 100;
  options.tolerance_mm = 0.02;
  return options;
}

}  // namespace kcs::test
