#include "server/planning/corner_list.h"

#include <gtest/gtest.h>

namespace kcs::planning {
namespace {

Corner corner(std::size_t i) {
  const auto x = static_cast<double>(i);
  Corner result{.segment = i,
                .line = static_cast<std::uint32_t>(7 * i),
                .point = Vector(x, -x, 1 / (x + 1)),
                .angle = 0.1 * x,
                .strategy = i % 2 == 0 ? CornerStrategy::kOverlapping : CornerStrategy::kBlended,
                .speed = 3 * x,
                .corner_distance = 4 * x,
                .contour_error = 5 * x,
                .time_lost = 6 * x};
  if (i % 2 == 1) {
    result.boundary_acceleration = 7 * x;
    result.duration = 8 * x;
  }
  if (i % 3 == 1) result.dwell = 9 * x;
  return result;
}

TEST(CornerList, GivesBackWhatWasAppended) {
  CornerList list;
  EXPECT_TRUE(list.empty());
  constexpr std::size_t kCorners = 1000;
  for (std::size_t i = 0; i < kCorners; ++i) list.append(corner(i));
  ASSERT_EQ(list.size(), kCorners);
  std::size_t i = 0;
  for (const Corner read : list) {
    const Corner expected = corner(i++);
    EXPECT_EQ(read.segment, expected.segment);
    EXPECT_EQ(read.line, expected.line);
    EXPECT_EQ(read.point, expected.point);
    EXPECT_EQ(read.angle, expected.angle);
    EXPECT_EQ(read.strategy, expected.strategy);
    EXPECT_EQ(read.speed, expected.speed);
    EXPECT_EQ(read.boundary_acceleration, expected.boundary_acceleration);
    EXPECT_EQ(read.duration, expected.duration);
    EXPECT_EQ(read.dwell, expected.dwell);
    EXPECT_EQ(read.corner_distance, expected.corner_distance);
    EXPECT_EQ(read.contour_error, expected.contour_error);
    EXPECT_EQ(read.time_lost, expected.time_lost);
  }
  EXPECT_EQ(i, kCorners);
  EXPECT_LE(list.bytes(), kCorners * 104);
}

}  // namespace
}  // namespace kcs::planning
