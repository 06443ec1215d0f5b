#include "server/motion/line.h"

#include <gtest/gtest.h>

namespace kcs::motion {
namespace {

TEST(DistanceToSegment, IsToTheNearestPointOfTheSegment) {
  const Vector from(0, 0, 0), to(10, 0, 0);
  EXPECT_DOUBLE_EQ(distance_to_segment({5, 3, 0}, from, to), 3);
  EXPECT_DOUBLE_EQ(distance_to_segment({2, 3, 0}, from, to), 3);
  EXPECT_DOUBLE_EQ(distance_to_segment({8, 0, 3}, from, to), 3);
  EXPECT_DOUBLE_EQ(distance_to_segment({-3, 4, 0}, from, to), 5);
  EXPECT_DOUBLE_EQ(distance_to_segment({13, 0, 4}, from, to), 5);
  EXPECT_DOUBLE_EQ(distance_to_segment({1, 1, 0}, from, from), std::sqrt(2));
}

}  // namespace
}  // namespace kcs::motion
