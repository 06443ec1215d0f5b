#include "server/planning/time_spline.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace kcs::planning {
namespace {

using motion::Phase;
using motion::State;

const Vector kOrigin(100, -20, 3);

// A motion that turns this way and that.
TimeSpline lively() {
  TimeSpline spline{.step = 0.002};
  for (int i = 0; i < 30; ++i) {
    spline.points.emplace_back(std::sin(1.3 * i), 0.2 * i + std::cos(2.1 * i), std::sin(0.4 * i * i));
    spline.ways.push_back(i);
  }
  return spline;
}

TEST(TimeSpline, HasPhasesThatFollowEachOther) {
  const TimeSpline spline = lively();
  ASSERT_EQ(spline.pieces(), 27u);
  EXPECT_DOUBLE_EQ(spline.duration(), 27 * 0.002);
  EXPECT_EQ(spline.phase(0, kOrigin).start_time, 0);
  for (std::size_t j = 0; j + 1 < spline.pieces(); ++j) {
    const Phase phase = spline.phase(j, kOrigin), next = spline.phase(j + 1, kOrigin);
    const State end = phase.at(phase.duration);
    EXPECT_NEAR(phase.end_time(), next.start_time, 1e-15) << j;
    EXPECT_LT((end.position - next.start.position).norm(), 1e-12) << j;
    EXPECT_LT((end.velocity - next.start.velocity).norm(), 1e-9) << j;
    EXPECT_LT((end.acceleration - next.start.acceleration).norm(), 1e-6) << j;
  }
}

TEST(TimeSpline, HasItsExtremesInItsDifferences) {
  const TimeSpline spline = lively();
  for (std::size_t j = 0; j < spline.pieces(); ++j) {
    const Phase phase = spline.phase(j, kOrigin);
    EXPECT_LT((phase.start.acceleration - spline.acceleration(j)).norm(), 1e-6);
    EXPECT_LT((phase.at(phase.duration).acceleration - spline.acceleration(j + 1)).norm(), 1e-6);
    EXPECT_LT((phase.jerk - spline.jerk(j)).norm(), 1e-3);
    for (int i = 0; i <= 20; ++i) {
      const State state = phase.at(phase.duration * i / 20);
      for (Eigen::Index axis = 0; axis < 3; ++axis) {
        const auto [least, most] =
            std::minmax({spline.velocity(j)[axis], spline.velocity(j + 1)[axis], spline.velocity(j + 2)[axis]});
        EXPECT_GE(state.velocity[axis], least - 1e-9);
        EXPECT_LE(state.velocity[axis], most + 1e-9);
      }
    }
  }
}

TEST(TimeSpline, StaysInsideTheHullOfFourPoints) {
  const TimeSpline spline = lively();
  for (std::size_t j = 0; j < spline.pieces(); ++j) {
    const Phase phase = spline.phase(j, kOrigin);
    EXPECT_LT((phase.start.position - kOrigin - spline.knot(j)).norm(), 1e-12);
    for (int i = 0; i <= 20; ++i) {
      const Vector at = phase.at(phase.duration * i / 20).position - kOrigin;
      for (Eigen::Index axis = 0; axis < 3; ++axis) {
        const auto [least, most] = std::minmax({spline.points[j][axis], spline.points[j + 1][axis],
                                                spline.points[j + 2][axis], spline.points[j + 3][axis]});
        EXPECT_GE(at[axis], least - 1e-12);
        EXPECT_LE(at[axis], most + 1e-12);
      }
    }
  }
}

TEST(TimeSpline, RestsAtThreeEqualPoints) {
  TimeSpline spline = lively();
  for (std::size_t i = 0; i < 3; ++i) {
    spline.points[i] = Vector(1, 2, 3);
    spline.points[spline.points.size() - 1 - i] = Vector(4, 5, 6);
  }
  const State begin = spline.phase(0, kOrigin).start;
  EXPECT_LT((begin.position - kOrigin - Vector(1, 2, 3)).norm(), 1e-13);
  EXPECT_EQ(begin.velocity, Vector::Zero());
  EXPECT_EQ(begin.acceleration, Vector::Zero());
  const Phase last = spline.phase(spline.pieces() - 1, kOrigin);
  const State end = last.at(last.duration);
  EXPECT_LT((end.position - kOrigin - Vector(4, 5, 6)).norm(), 1e-13);
  EXPECT_LT(end.velocity.norm(), 1e-9);
  EXPECT_LT(end.acceleration.norm(), 1e-6);
}

TEST(TimeSpline, BeginsSteadilyWithThreePointsOnALine) {
  TimeSpline spline = lively();
  const Vector velocity(30, 40, 0);
  for (int i = 0; i < 3; ++i) spline.points[static_cast<std::size_t>(i)] = Vector(7, 8, 9) + i * spline.step * velocity;
  const State begin = spline.phase(0, Vector::Zero()).start;
  EXPECT_LT((begin.position - spline.points[1]).norm(), 1e-13);
  EXPECT_LT((begin.velocity - velocity).norm(), 1e-9);
  EXPECT_LT(begin.acceleration.norm(), 1e-6);
}

}  // namespace
}  // namespace kcs::planning
