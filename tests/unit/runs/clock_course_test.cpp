#include "server/runs/clock_course.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace kcs::runs {
namespace {

ClockCourse braking() {
  ClockCourse course({10, 1, 0});
  for (const double bend : {-100.0, 0.0, 100.0}) {
    const ClockPhase stretch{course.end(), bend, 0.1 / (bend == 0 ? 2 : 1)};
    course.add(stretch, stretch.end());
  }
  return course;
}

TEST(ClockCourse, IsCutWithoutLosingOrRepeatingAnything) {
  for (const double at : {0.0, 0.05, 0.1, 0.12, 0.15, 0.2, 0.25, 1.0}) {
    ClockCourse first = braking();
    const double whole = first.duration();
    const ClockState end = first.end();
    const ClockCourse rest = first.cut(at);
    EXPECT_NEAR(first.duration(), std::min(at, whole), 1e-12) << at;
    EXPECT_NEAR(first.duration() + rest.duration(), whole, 1e-12) << at;
    EXPECT_EQ(rest.end().plan_time, rest.stretches().empty() ? first.end().plan_time : end.plan_time) << at;
    if (rest.stretches().empty()) continue;
    EXPECT_NEAR(rest.stretches().front().start.plan_time, first.end().plan_time, 1e-12) << at;
    EXPECT_NEAR(rest.stretches().front().start.rate, first.end().rate, 1e-12) << at;
    EXPECT_NEAR(rest.stretches().front().start.rate_change, first.end().rate_change, 1e-12) << at;
  }
}

}  // namespace
}  // namespace kcs::runs
