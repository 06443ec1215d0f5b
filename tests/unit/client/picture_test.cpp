// What a picture shows: thinned data with the peaks kept.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "client/cli/path_outline.h"
#include "client/cli/time_series.h"

namespace kcs::cli {
namespace {

TEST(TimeSeries, KeepsEverySampleIfThereAreFew) {
  TimeSeries series(1, 2, 100);
  series.add(1.0, 5);
  series.add(1.5, -7);
  series.add(2.0, 9);
  EXPECT_EQ(series.points(), (std::vector<std::pair<double, double>>{{1.0, 5}, {1.5, -7}, {2.0, 9}}));
}

TEST(TimeSeries, KeepsSingleSamplePeaksOfALongRow) {
  TimeSeries series(0, 1000, 500);
  for (int i = 0; i < 1'000'000; ++i) {
    series.add(i * 0.001, i == 123'456 ? 100.0 : i == 654'321 ? -100.0 : std::sin(i * 0.01));
  }
  const auto points = series.points();
  EXPECT_LE(points.size(), 1000);
  EXPECT_TRUE(std::is_sorted(points.begin(), points.end(), [](auto& a, auto& b) { return a.first < b.first; }));
  EXPECT_EQ(std::count(points.begin(), points.end(), std::make_pair(123'456 * 0.001, 100.0)), 1);
  EXPECT_EQ(std::count(points.begin(), points.end(), std::make_pair(654'321 * 0.001, -100.0)), 1);
}

TEST(PathOutline, DropsWhatNobodySeesAndKeepsCorners) {
  PathOutline outline;
  for (int i = 0; i <= 100'000; ++i) outline.add({i * 0.001, 0, 10});
  for (int i = 1; i <= 100'000; ++i) outline.add({100, i * 0.001, 10});
  const auto strokes = outline.strokes(1000);
  ASSERT_EQ(strokes.size(), 1);
  ASSERT_EQ(strokes[0].size(), 3);
  EXPECT_NEAR(strokes[0][1].x, 100, 0.1);
  EXPECT_NEAR(strokes[0][1].y, 0, 0.1);
}

TEST(PathOutline, DividesStraightLinesWhereTheSpeedChanges) {
  PathOutline outline;
  outline.add({0, 0, 0});
  outline.add({10, 0, 100});
  const auto strokes = outline.strokes(1000);
  ASSERT_EQ(strokes.size(), 1);
  ASSERT_EQ(strokes[0].size(), 26);
  EXPECT_DOUBLE_EQ(strokes[0][13].speed - strokes[0][12].speed, 4);
}

// A square spiral, drawn as often as a printer lays layers: too much for a small picture.
TEST(PathOutline, LeavesOutLayersBelowOthersWhenThereAreTooMany) {
  PathOutline outline;
  for (int layer = 0; layer < 300; ++layer) {
    for (int turn = 0; turn < 400; ++turn) {
      const double radius = 50 - turn / 8.0;
      const double angle = turn * std::numbers::pi / 2;
      outline.add({radius * std::cos(angle), radius * std::sin(angle), 10});
    }
  }
  const auto strokes = outline.strokes(500);
  std::size_t pieces = 0;
  double longest = 0;
  for (const Stroke& stroke : strokes) {
    ASSERT_GE(stroke.size(), 2);
    pieces += stroke.size() - 1;
    for (const OutlinePoint& point : stroke) longest = std::max(longest, std::hypot(point.x, point.y));
  }
  EXPECT_LE(pieces, 500);
  EXPECT_GE(pieces, 50);
  EXPECT_DOUBLE_EQ(longest, 50);
}

TEST(PathOutline, AToolThatDoesNotMoveIsNoProblem) {
  PathOutline outline;
  EXPECT_TRUE(outline.strokes(10).empty());
  for (int i = 0; i < 100; ++i) outline.add({1, 2, 0});
  EXPECT_EQ(outline.strokes(10).size(), 1);
}

}  // namespace
}  // namespace kcs::cli
