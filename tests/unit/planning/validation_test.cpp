#include "server/planning/validation.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <limits>
#include <string>

#include "server/planning/invalid_input.h"
#include "tests/unit/planning/paths.h"

namespace kcs::planning {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

struct Problem {
  Toolpath path = two_legs(90, 0.05);
  PlanOptions options = options_for(2000, 1e5, ToleranceKind::kContourError, CornerStrategy::kAuto);
};

struct BadInput {
  std::string field;
  std::function<void(Problem&)> spoil;
};

void PrintTo(const BadInput& input, std::ostream* out) { *out << input.field; }

class Validation : public testing::TestWithParam<BadInput> {};

TEST_P(Validation, NamesTheField) {
  Problem problem;
  validate(problem.path, problem.options);
  GetParam().spoil(problem);
  try {
    plan(problem.path, problem.options);
    FAIL() << "accepted";
  } catch (const InvalidInput& error) {
    EXPECT_EQ(error.violations().at(0).field, GetParam().field);
    EXPECT_THAT(error.violations().at(0).description, testing::HasSubstr("give"));
  }
}

INSTANTIATE_TEST_SUITE_P(
    BadInput, Validation,
    testing::Values(BadInput{"limits.axes", [](Problem& p) { p.options.limits.axes = 4; }},
                    BadInput{"limits.axes", [](Problem& p) { p.options.limits.axes = 0; }},
                    BadInput{"limits.velocity[0]", [](Problem& p) { p.options.limits.velocity[0] = kNaN; }},
                    BadInput{"limits.velocity[1]", [](Problem& p) { p.options.limits.velocity[1] = -1; }},
                    BadInput{"limits.acceleration[1]", [](Problem& p) { p.options.limits.acceleration[1] = 0; }},
                    BadInput{"limits.jerk[0]", [](Problem& p) { p.options.limits.jerk[0] = INFINITY; }},
                    BadInput{"path", [](Problem& p) { p.path.segments.clear(); }},
                    BadInput{"path, start, x", [](Problem& p) { p.path.start[0] = 1e8; }},
                    BadInput{"path, segment 1, y", [](Problem& p) { p.path.segments[1].end[1] = kNaN; }},
                    BadInput{"path, segment 0, x", [](Problem& p) { p.path.segments[0].end[0] = 1e308; }},
                    BadInput{"path, segment 1, z", [](Problem& p) { p.path.segments[1].end[2] = 1; }},
                    BadInput{"path, segment 0, feed", [](Problem& p) { p.path.segments[0].feed = 0; }},
                    BadInput{"path, segment 0, feed", [](Problem& p) { p.path.segments[0].feed = kNaN; }},
                    BadInput{"path, segment 0, feed", [](Problem& p) { p.path.segments[0].feed = -INFINITY; }},
                    BadInput{"path, segment 1, tolerance", [](Problem& p) { p.path.segments[1].tolerance = -1e-9; }},
                    BadInput{"path, segment 1, tolerance", [](Problem& p) { p.path.segments[1].tolerance = INFINITY; }},
                    BadInput{"path, segment 0, dwell", [](Problem& p) { p.path.segments[0].dwell = -1; }},
                    BadInput{"path, segment 0, dwell", [](Problem& p) { p.path.segments[0].dwell = kNaN; }}));

TEST(Validation, NamesNoMoreThanSoManyPlaces) {
  Problem problem;
  problem.path.segments.assign(1000, {.end = Vector(kNaN, 0, 0), .feed = kNaN});
  try {
    validate(problem.path, problem.options);
    FAIL() << "accepted";
  } catch (const InvalidInput& error) {
    EXPECT_EQ(error.violations().size(), kMaxViolations);
  }
}

}  // namespace
}  // namespace kcs::planning
