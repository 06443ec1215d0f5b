#include "server/planning/blended.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <tuple>
#include <vector>

#include "tests/unit/planning/paths.h"

namespace kcs::planning {
namespace {

// Over angles, shares of the jerk and swings; the axes differ.
class Blends : public testing::TestWithParam<std::tuple<double, double, double>> {
 protected:
  Blends() : legs_(legs_of(two_legs(angle(), kTolerance, kFeed), options().limits)) {}

  static constexpr double kTolerance = 0.05, kFeed = 60;

  static double angle() { return std::get<0>(GetParam()); }
  static PlanOptions options() {
    PlanOptions options = options_for(2000, 1e5, ToleranceKind::kContourError, CornerStrategy::kBlended);
    options.limits.velocity = {55, 90, 0};
    options.limits.acceleration.y() = 1200;
    options.limits.jerk.x() = 6e4;
    return options;
  }
  CornerGeometry corner() const { return corner_geometry(legs_.legs[0], legs_.legs[1], options()); }
  Blended blended() const { return {corner(), options().limits, {std::get<1>(GetParam()), std::get<2>(GetParam())}}; }

  // The states of the corner at `speed`, at the ends of its phases and between them.
  std::vector<motion::State> states(double speed) const {
    std::vector<motion::Phase> phases;
    blended().append_phases(corner(), speed, phases);
    std::vector<motion::State> result;
    for (const motion::Phase& phase : phases) {
      for (int i = 0; i <= 16; ++i) result.push_back(phase.at(phase.duration * i / 16));
    }
    return result;
  }

  // The fastest, one without hold, and slow ones.
  std::vector<double> speeds() const {
    const double most = blended().max_speed();
    return {most, 0.9 * most, 0.5 * most, 0.01 * most};
  }

  static constexpr double kRounding = 1 + 1e-9;
  LegPath legs_;
};

TEST_P(Blends, KeepTheLimitsOfEveryAxis) {
  const AxisLimits limits = options().limits;
  for (const double speed : speeds()) {
    for (const motion::State& state : states(speed)) {
      EXPECT_LE(state.velocity.norm(), kFeed * kRounding);
      for (std::size_t axis = 0; axis < limits.axes; ++axis) {
        EXPECT_LE(std::abs(state.velocity[axis]), limits.velocity[axis] * kRounding);
        EXPECT_LE(std::abs(state.acceleration[axis]), limits.acceleration[axis] * kRounding);
      }
    }
    std::vector<motion::Phase> phases;
    blended().append_phases(corner(), speed, phases);
    for (const motion::Phase& phase : phases) {
      for (std::size_t axis = 0; axis < limits.axes; ++axis) {
        EXPECT_LE(std::abs(phase.jerk[axis]), limits.jerk[axis] * kRounding);
      }
    }
  }
}

TEST_P(Blends, StayInsideTheCornerAndInsideTheTolerance) {
  const auto distance_inside = [](const Leg& leg, const Vector& point) {
    const Vector from = point - leg.end;
    return leg.direction.x() * from.y() - leg.direction.y() * from.x();  // the corner turns left
  };
  for (const double speed : speeds()) {
    for (const motion::State& state : states(speed)) {
      const double in = distance_inside(legs_.legs[0], state.position);
      const double out = distance_inside(legs_.legs[1], state.position);
      EXPECT_GE(std::min(in, out), -1e-12);
      EXPECT_LE(std::min(in, out), kTolerance);
    }
  }
}

TEST_P(Blends, LeaveRoomToReachTheirLevelOnTheLeg) {
  for (const Leg& leg : legs_.legs) {
    EXPECT_LE(blended().at(blended().max_speed()).level(leg.jerk), leg.feed * kRounding);
  }
}

INSTANTIATE_TEST_SUITE_P(Corners, Blends,
                         testing::Combine(testing::Values(0.5, 15., 60., 90., 120., 174.),
                                          testing::Values(0.05, 0.5, 0.95), testing::Values(0., 0.5, 1.)));

TEST(Blended, DoesNotSuitCornersWithoutAPlane) {
  const PlanOptions options = options_for(2000, 1e5, ToleranceKind::kContourError, CornerStrategy::kAuto);
  const auto suits = [&](double degrees) {
    const LegPath legs = legs_of(two_legs(degrees, 0.05), options.limits);
    return Blended::suits(corner_geometry(legs.legs[0], legs.legs[1], options));
  };
  EXPECT_FALSE(suits(0.01));
  EXPECT_TRUE(suits(0.5));
  EXPECT_TRUE(suits(174));
  EXPECT_FALSE(suits(176));
  EXPECT_FALSE(suits(180));
}

}  // namespace
}  // namespace kcs::planning
