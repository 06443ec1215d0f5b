#include "server/planning/cornering.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "tests/unit/planning/paths.h"

namespace kcs::planning {
namespace {

// Every strategy, over the angles.
class Families : public testing::TestWithParam<std::tuple<CornerStrategy, double>> {
 protected:
  Families()
      : options_(options_for(2000, 1e5, ToleranceKind::kCornerDistance, std::get<0>(GetParam()))),
        legs_(legs_of(two_legs(std::get<1>(GetParam()), 0.05), options_.limits)),
        corner_(corner_geometry(legs_.legs[0], legs_.legs[1], options_)),
        cornering_(choose_cornering(corner_, options_.strategy, options_.limits)) {}

  PlanOptions options_;
  LegPath legs_;
  CornerGeometry corner_;
  Cornering cornering_;
};

TEST_P(Families, GrowWithTheSpeed) {
  CornerMotion slower;
  for (int i = 1; i <= 100; ++i) {
    const CornerMotion motion = cornering_.at(cornering_.max_speed() * i / 100);
    EXPECT_GT(motion.length, slower.length);
    EXPECT_GT(motion.duration, slower.duration * (1 - 1e-12));
    EXPECT_GT(motion.cut, slower.cut);
    EXPECT_GE(motion.acceleration, slower.acceleration);
    EXPECT_GT(motion.level(1e5), slower.level(1e5));
    slower = motion;
  }
  EXPECT_LE(slower.cut, 0.05);
}

TEST_P(Families, InvertTheirLevel) {
  for (int i = 1; i <= 100; ++i) {
    const double speed = cornering_.max_speed() * i / 100;
    EXPECT_NEAR(cornering_.speed_at_level(cornering_.at(speed).level(1e5), 1e5), speed, 1e-9 * speed);
  }
}

TEST_P(Families, BeginAndEndOnTheLegsAsTheySay) {
  for (int i = 1; i <= 10; ++i) {
    const double speed = cornering_.max_speed() * i / 10;
    const CornerMotion motion = cornering_.at(speed);
    std::vector<motion::Phase> phases;
    cornering_.append_phases(corner_, speed, phases);
    motion::State at{.position = corner_.in.end - motion.length * corner_.in.direction,
                     .velocity = speed * corner_.in.direction,
                     .acceleration = -motion.acceleration * corner_.in.direction};
    double nearest = 1e9, duration = 0;
    const auto expect_same = [](const motion::State& a, const motion::State& b) {
      EXPECT_LT((a.position - b.position).norm(), 1e-12);
      EXPECT_LT((a.velocity - b.velocity).norm(), 1e-10);
      EXPECT_LT((a.acceleration - b.acceleration).norm(), 1e-8);
    };
    for (const motion::Phase& phase : phases) {
      expect_same(at, phase.start);
      nearest = std::min({nearest, (phase.at(phase.duration / 2).position - corner_.in.end).norm(),
                          (phase.at(phase.duration).position - corner_.in.end).norm()});
      at = phase.at(phase.duration);
      duration += phase.duration;
    }
    expect_same(at, {.position = corner_.out.start + motion.length * corner_.out.direction,
                     .velocity = speed * corner_.out.direction,
                     .acceleration = motion.acceleration * corner_.out.direction});
    EXPECT_NEAR(nearest, motion.cut, 1e-12);
    EXPECT_NEAR(duration, motion.duration, 1e-14);
  }
}

INSTANTIATE_TEST_SUITE_P(Corners, Families,
                         testing::Combine(testing::Values(CornerStrategy::kInterrupted, CornerStrategy::kUninterrupted,
                                                          CornerStrategy::kBlended),
                                          testing::Values(1e-3, 1., 10., 45., 90., 135., 170., 179.999, 180.)));

TEST(Cornering, StopsWithoutATolerance) {
  const PlanOptions options = options_for(2000, 1e5, ToleranceKind::kContourError, CornerStrategy::kAuto);
  const LegPath legs = legs_of(two_legs(90, 0), options.limits);
  const CornerGeometry corner = corner_geometry(legs.legs[0], legs.legs[1], options);
  EXPECT_EQ(choose_cornering(corner, options.strategy, options.limits).max_speed(), 0);
}

TEST(Cornering, BlendsExceptWhereThePapersCornersAreFaster) {
  const auto chosen = [](double degrees, double tolerance) {
    const PlanOptions options = options_for(2500, 2e5, ToleranceKind::kCornerDistance, CornerStrategy::kAuto);
    const LegPath legs = legs_of(two_legs(degrees, tolerance), options.limits);
    const CornerGeometry corner = corner_geometry(legs.legs[0], legs.legs[1], options);
    return choose_cornering(corner, options.strategy, options.limits).strategy();
  };
  EXPECT_EQ(chosen(10, 0.1), CornerStrategy::kInterrupted);  // at the feed
  EXPECT_EQ(chosen(10, 0.001), CornerStrategy::kBlended);
  EXPECT_EQ(chosen(90, 0.02), CornerStrategy::kBlended);
  EXPECT_EQ(chosen(120, 0.01), CornerStrategy::kUninterrupted);
  EXPECT_EQ(chosen(180, 0.02), CornerStrategy::kUninterrupted);
}

TEST(Cornering, SmoothsWhatAnAxisWouldNoticeHoweverSlightItIs) {
  PlanOptions options = options_for(2000, 1e5, ToleranceKind::kContourError, CornerStrategy::kAuto);
  const LegPath legs = legs_of(path_through({{1000, 0, 0}, {1999, 8e-10, 0}}, 500, 0.01), options.limits);
  ASSERT_EQ(legs.legs.size(), 2u);
  EXPECT_TRUE(corner_geometry(legs.legs[0], legs.legs[1], options).straight);
  options.limits.velocity.y() = 0.5;
  EXPECT_FALSE(corner_geometry(legs.legs[0], legs.legs[1], options).straight);
}

}  // namespace
}  // namespace kcs::planning
