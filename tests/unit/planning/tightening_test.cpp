// What is gained by it, and what stays.
#include "server/planning/tightening.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "server/motion/verifier.h"
#include "server/planning/motion_builder.h"
#include "server/planning/stretch.h"
#include "tests/unit/planning/paths.h"

namespace kcs::planning {
namespace {

constexpr double kTolerance = 0.05;

PlanOptions options_with(Effort effort) {
  PlanOptions options = options_for(2000, 1e5, ToleranceKind::kContourError, CornerStrategy::kAuto);
  options.effort = effort;
  return options;
}

Stretch stretch_of(const LegPath& legs, Effort effort) {
  return {legs, {0, legs.legs.size() - 1, 0, 0}, options_with(effort), {}};
}

// Legs of these lengths that turn by 60° to the left or by 120° to the right, as they fall.
LegPath crowded(std::uint32_t seed, double least, double most) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> length(least, most);
  Toolpath path;
  Vector end = Vector::Zero();
  double angle = 0;
  for (int i = 0; i < 60; ++i) {
    end += length(random) * Vector(std::cos(angle), std::sin(angle), 0);
    path.segments.push_back({.end = end, .feed = 100, .tolerance = kTolerance});
    angle += random() % 2 == 0 ? std::numbers::pi / 3 : -2 * std::numbers::pi / 3;
  }
  return legs_of(path, options_with(Effort::kUsual).limits);
}

double mean_gain(double least, double most) {
  double before = 0, after = 0;
  for (std::uint32_t seed = 1; seed <= 20; ++seed) {
    const LegPath path = crowded(seed, least, most);
    Stretch stretch = stretch_of(path, Effort::kUsual);
    if (stretch.failed()) continue;
    before += stretch.duration();
    stretch.tighten(stretch.pieces().size());
    after += stretch.duration();
  }
  return 1 - after / before;
}

TEST(Tightening, TravelsCrowdedCornersFaster) { EXPECT_GT(mean_gain(0.3, 0.5), 0.02); }

TEST(Tightening, TravelsCornersFarFromEachOtherFaster) { EXPECT_GT(mean_gain(1, 3), 0.015); }

// In motion where it ends, and beside a corner or wherever else that happens to be.
TEST(Tightening, TravelsEachOfManyPartsFaster) {
  std::size_t parts = 0, hardly = 0;
  for (std::uint32_t seed = 1; seed <= 40; ++seed) {
    const LegPath path = crowded(seed, 0.5, 1.5);
    Stretch stretch = stretch_of(path, Effort::kUsual);
    if (stretch.failed()) continue;
    const std::size_t part = stretch.pieces().size() * 2 / 3;
    const double before = stretch.pieces()[part].phase.start_time;
    stretch.tighten(part);
    ++parts;
    if (stretch.pieces()[part].phase.start_time > 0.995 * before) ++hardly;
  }
  EXPECT_GE(parts, 30U);
  EXPECT_LE(hardly, parts / 20);
}

TEST(Tightening, KeepsLimitsAndTheTolerance) {
  for (std::uint32_t seed = 1; seed <= 20; ++seed) {
    const LegPath path = crowded(seed, 0.1, 1);
    Stretch stretch = stretch_of(path, Effort::kUsual);
    if (stretch.failed()) continue;
    stretch.tighten(stretch.pieces().size());
    const AxisLimits limits = options_with(Effort::kUsual).limits;
    motion::Verifier verifier({}, limits);
    for (std::size_t i = 0; i < path.legs.size(); ++i) {
      const bool last = i + 1 == path.legs.size();
      const double reach = last ? 0 : stretch.path().reach(i);
      verifier.add({.end = path.legs[i].end, .feed = 100, .tolerance = kTolerance, .reach = reach});
    }
    MotionBuilder builder(0);
    builder.stretch(stretch);
    for (const motion::Phase& phase : builder.phases()) verifier.follow(phase);
    EXPECT_EQ(verifier.finish({.position = path.legs.back().end}).fault, "") << seed;
  }
}

// What comes after it goes on from there.
TEST(Tightening, StaysAsItIsWhereItEnds) {
  const LegPath path = crowded(3, 0.3, 0.5);
  Stretch stretch = stretch_of(path, Effort::kUsual);
  ASSERT_FALSE(stretch.failed());
  const std::vector<StretchPiece> before(stretch.pieces().begin(), stretch.pieces().end());
  const std::size_t half = before.size() / 2;
  stretch.tighten(half);
  const auto after = stretch.pieces();
  ASSERT_EQ(after.size(), before.size());
  EXPECT_LT(after[half].phase.start_time, 0.99 * before[half].phase.start_time);
  const motion::State end = after[half - 1].phase.at(after[half - 1].phase.duration), next = before[half].phase.start;
  EXPECT_LT((end.position - next.position).norm(), 1e-9);
  EXPECT_LT((end.velocity - next.velocity).norm(), 1e-7);
  EXPECT_LT((end.acceleration - next.acceleration).norm(), 1e-4);
  EXPECT_NEAR(after[half].phase.start_time, after[half - 1].phase.end_time(), 1e-12);
  for (std::size_t i = half; i < before.size(); ++i) {
    EXPECT_EQ(after[i].phase.start.position, before[i].phase.start.position);
    EXPECT_EQ(after[i].phase.jerk, before[i].phase.jerk);
    EXPECT_EQ(after[i].from, before[i].from);
  }
}

// A wave in legs of 0.2 mm: dense. As one part of many it is to be planned quickly; alone it gets what there is to get.
TEST(Tightening, LeavesDensePartsAsTheyAre) {
  Toolpath path;
  for (int i = 1; i <= 300; ++i) {
    const double x = 0.2 * i;
    path.segments.push_back({.end = {x, 3 * std::sin(x / 4), 0}, .feed = 100, .tolerance = 0.01});
  }
  const LegPath legs = legs_of(path, options_with(Effort::kUsual).limits);
  const auto gain = [&](Effort effort) {
    Stretch stretch = stretch_of(legs, effort);
    const double before = stretch.duration();
    stretch.tighten(stretch.pieces().size());
    return before - stretch.duration();
  };
  EXPECT_EQ(gain(Effort::kUsual), 0);
  EXPECT_GT(gain(Effort::kFull), 0);
}

TEST(Tightening, IsNotWaitedForByTheMachine) {
  const LegPath path = crowded(3, 0.3, 0.5);
  Stretch stretch = stretch_of(path, Effort::kLeast);
  ASSERT_FALSE(stretch.failed());
  const double before = stretch.duration();
  stretch.tighten(stretch.pieces().size());
  EXPECT_EQ(stretch.duration(), before);
}

TEST(Tightening, IsTheSameAgain) {
  const LegPath path = crowded(5, 0.3, 0.5);
  const auto tightened = [&] {
    Stretch stretch = stretch_of(path, Effort::kFull);
    stretch.tighten(stretch.pieces().size());
    return std::vector<StretchPiece>(stretch.pieces().begin(), stretch.pieces().end());
  };
  const auto one = tightened(), other = tightened();
  ASSERT_EQ(one.size(), other.size());
  for (std::size_t i = 0; i < one.size(); ++i) EXPECT_EQ(one[i].phase.jerk, other[i].phase.jerk) << i;
}

}  // namespace
}  // namespace kcs::planning
