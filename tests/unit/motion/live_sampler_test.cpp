// The same setpoints as of the whole trajectory, while it is still being made.
#include "server/motion/live_sampler.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <random>
#include <vector>

#include "server/motion/sampler.h"

namespace kcs::motion {
namespace {

bool same_bits(const Setpoint& a, const Setpoint& b) {
  const auto same = [](const Vector& x, const Vector& y) { return std::memcmp(x.data(), y.data(), sizeof x) == 0; };
  return same(a.state.position, b.state.position) && same(a.state.velocity, b.state.velocity) &&
         same(a.state.acceleration, b.state.acceleration) && same(a.jerk, b.jerk);
}

// Phases one after the other; each says by its jerk which it is.
std::vector<Phase> phases_of(const std::vector<double>& durations) {
  std::vector<Phase> phases;
  double time = 0;
  for (const double duration : durations) {
    Phase phase{.start_time = time, .duration = duration};
    phase.start.position.x() = time;
    phase.start.velocity.y() = static_cast<double>(phases.size());
    phase.jerk.z() = 1 + static_cast<double>(phases.size());
    phases.push_back(phase);
    time = phase.end_time();
  }
  return phases;
}

void expect_same(const std::vector<double>& durations, double period) {
  const State end{.position = {7, 8, 9}};
  const std::vector<Phase> phases = phases_of(durations);
  Trajectory trajectory;
  for (const Phase& phase : phases) trajectory.append(phase);
  trajectory.set_final_state(end);
  Sampler whole(trajectory, period);

  LiveSampler live(period);
  std::uint64_t index = 0;
  const auto take = [&] {
    while (const auto setpoint = live.next()) {
      ASSERT_LT(index, whole.count()) << "period " << period;
      ASSERT_TRUE(same_bits(*setpoint, whole.at(index))) << "setpoint " << index << ", period " << period;
      ++index;
      EXPECT_EQ(live.given(), index);
    }
  };
  for (const Phase& phase : phases) {
    live.add(phase);
    take();
    EXPECT_FALSE(live.ended());
  }
  live.finish(end);
  take();
  EXPECT_EQ(index, whole.count()) << "period " << period;
  EXPECT_TRUE(live.ended());
  EXPECT_FALSE(live.next());
}

TEST(LiveSampler, GivesTheSameSetpointsAsOfTheWholeTrajectory) {
  std::mt19937_64 random(1);
  const auto uniform = [&] { return std::ldexp(static_cast<double>(random() >> 11), -53); };
  for (int round = 0; round < 2000; ++round) {
    std::vector<double> durations(random() % 40);
    for (double& duration : durations) {
      switch (random() % 5) {
        case 0:
          duration = 0.001 * static_cast<double>(1 + random() % 5);
          break;
        case 1:
          duration = std::exp(-40 * uniform());
          break;
        default:
          duration = uniform();
      }
    }
    expect_same(durations, round % 2 == 0 ? 0.001 : std::exp(std::log(1e-3) + 9 * uniform()));
  }
}

// Where rounding decides whether a setpoint is the end, or one before it.
TEST(LiveSampler, GivesTheSameSetpointsWherePhasesEndOnThePeriod) {
  for (const double period : {0.001, 0.1, 0.7, 1.0, 1e-5}) {
    for (const double off : {-1e-9, -1e-13, -1e-16, 0.0, 1e-16, 1e-13, 1e-9}) {
      expect_same({period * (1 + off), period, 3 * period * (1 + off), period / 3, period * (2 + off)}, period);
      expect_same({1000 * period * (1 + off), 1e-13 * period, 1e-13 * period, period}, period);
      expect_same({1000 * period * (1 + off)}, period);
    }
  }
}

TEST(LiveSampler, HasOneSetpointForNoMotion) { expect_same({}, 0.001); }

TEST(LiveSampler, WaitsWithWhatMayBeTheEnd) {
  LiveSampler live(1);
  live.add({.duration = 2.5});
  std::uint64_t certain = 0;
  while (live.next()) ++certain;
  EXPECT_EQ(certain, 3U);  // at 0, 1 and 2 s
  live.add({.start_time = 2.5, .duration = 0.5});
  EXPECT_FALSE(live.next()) << "the motion could end here";
  live.add({.start_time = 3, .duration = 0.001});
  EXPECT_TRUE(live.next());
}

}  // namespace
}  // namespace kcs::motion
