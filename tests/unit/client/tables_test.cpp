// What people read: numbers, tables and the progress bar.
#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>
#include <string>
#include <utility>

#include "client/cli/corners_table.h"
#include "client/cli/numbers.h"
#include "client/cli/plan_table.h"
#include "client/cli/slow_spots.h"
#include "client/common/progress_bar.h"

namespace kcs::cli {
namespace {

using client::Corner;

// Columns on the terminal: every byte but the continuation bytes of UTF-8.
std::size_t width(const std::string& line) {
  return static_cast<std::size_t>(std::count_if(line.begin(), line.end(), [](char c) { return (c & 0xC0) != 0x80; }));
}

void expect_fits(const std::string& text) {
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) EXPECT_LE(width(line), 80) << line;
}

TEST(Numbers, ReadWell) {
  EXPECT_EQ(clock_time(3723.4), "1:02:03");
  EXPECT_EQ(clock_time(59.6), "0:01:00");
  EXPECT_EQ(with_commas(0), "0");
  EXPECT_EQ(with_commas(999), "999");
  EXPECT_EQ(with_commas(1234567), "1,234,567");
  EXPECT_EQ(decimal(-12.345, 1), "-12.3");
  EXPECT_EQ(decimal(-1e-9, 2), "0.00");
  EXPECT_EQ(short_number(20000), "20000");
  EXPECT_EQ(short_number(-12.345), "-12.35");
  EXPECT_EQ(short_number(0), "0.0000");
  EXPECT_EQ(percentage(1, 8), "12.5 %");
  EXPECT_EQ(percentage(1, 0), "0.0 %");
}

TEST(SlowSpots, CornersOfOneLineCountTogether) {
  const std::vector<Corner> corners = {
      {.line = 1, .angle_deg = 90, .speed_mm_s = 5, .time_lost_s = 0.3, .point_mm = {0, 0}},
      {.line = 2, .angle_deg = 2, .speed_mm_s = 50, .time_lost_s = 0.2, .point_mm = {1, 0}},
      {.line = 2, .angle_deg = 3, .speed_mm_s = 40, .time_lost_s = 0.25, .point_mm = {2, 0}},
      {.line = 3, .angle_deg = 1, .speed_mm_s = 60, .time_lost_s = 0, .point_mm = {3, 0}}};
  const std::vector<SlowSpot> spots = slowest_spots(corners, 10);
  ASSERT_EQ(spots.size(), 2);
  EXPECT_EQ(spots[0].line, 2);
  EXPECT_EQ(spots[0].corners, 2);
  EXPECT_EQ(spots[0].point_mm, (std::vector<double>{2, 0}));
  EXPECT_DOUBLE_EQ(spots[0].largest_angle_deg, 3);
  EXPECT_DOUBLE_EQ(spots[0].lowest_speed_mm_s, 40);
  EXPECT_DOUBLE_EQ(spots[0].time_lost_s, 0.45);
  EXPECT_EQ(spots[1].line, 1);
  EXPECT_EQ(slowest_spots(corners, 1).size(), 1);
}

TEST(PlanTable, ShowsTheFiguresAndFitsEightyColumns) {
  client::Plan plan;
  plan.options.machine = {.name = "CNC router",
                          .axes = 3,
                          .velocity_mm_s = {200, 200, 100},
                          .acceleration_mm_s2 = {1000, 1000, 600},
                          .jerk_mm_s3 = {20000, 20000, 12000}};
  plan.options.tolerance_mm = 0.01;
  plan.summary.cycle_time_s = 3723.4;
  plan.summary.segment_count = 44304;
  plan.summary.max_velocity_mm_s = {199.99, 12.5, 3};
  plan.summary.max_acceleration_mm_s2 = {1000, 1000, 600};
  plan.summary.max_jerk_mm_s3 = {20000, 20000, 12000};
  plan.notices = {
      {12, "a long notice that goes on and on, so that it does not fit into a single line of the table", 3}};
  const Corner corner{.line = 4711,
                      .angle_deg = 135,
                      .speed_mm_s = 7.1,
                      .time_lost_s = 0.123,
                      .point_mm = {-1234.567, 2345.678, -3456.789}};
  const std::string table = plan_table("part.ngc", plan, {corner});
  expect_fits(table);
  for (const char* piece : {"1:02:03   (3723.400 s)", "44,304 segments", "200.0 / 200", "20000 / 20000", "4711",
                            "-1234.567", " 0.123\n", "line 12", "(×3)", "tolerance 0.01 mm (contour)"}) {
    EXPECT_NE(table.find(piece), std::string::npos) << piece << "\n" << table;
  }
}

TEST(PlanTable, CountsTheStrategiesThatOccur) {
  client::Plan plan;
  plan.summary.corner_count = 1'000'630;
  plan.summary.blended_count = 1'000'000;
  plan.summary.overlapping_count = 627;
  plan.summary.exact_stop_count = 3;
  const std::string table = plan_table("part.ngc", plan, {});
  EXPECT_NE(table.find("Corners             1,000,630\n"
                       "  blended           1,000,000\n"
                       "  overlapping       627\n"
                       "  exact stops       3\n"
                       "Lost at corners"),
            std::string::npos)
      << table;
}

TEST(CornersTable, NamesTheStrategyOfEachCorner) {
  for (const auto& [strategy, name] : {std::pair{client::CornerStrategy::kInterrupted, " interrupted "},
                                       {client::CornerStrategy::kUninterrupted, " uninterrupted "},
                                       {client::CornerStrategy::kExactStop, " exact-stop "},
                                       {client::CornerStrategy::kBlended, " blended "},
                                       {client::CornerStrategy::kOverlapping, " overlapping "}}) {
    EXPECT_NE(corners_table({{.strategy = strategy}}).find(name), std::string::npos) << name;
  }
}

TEST(CornersTable, HasALineForEachCornerAndFitsEightyColumns) {
  const Corner corner{.segment = 123456,
                      .line = 654321,
                      .angle_deg = 179.99,
                      .strategy = client::CornerStrategy::kUninterrupted,
                      .speed_mm_s = 1234.5,
                      .duration_s = 12.5,
                      .deviation_mm = 999,
                      .time_lost_s = 12.5};
  const std::string table = corners_table({corner, corner});
  expect_fits(table);
  EXPECT_EQ(std::count(table.begin(), table.end(), '\n'), 4);
}

TEST(ProgressLine, KeepsToItsWidth) {
  EXPECT_EQ(client::progress_line("setpoints", 5, 10, 26), "setpoints [====    ]  50 %");
  EXPECT_EQ(client::progress_line("setpoints", 10, 10, 8), "100 %");
  for (std::size_t columns = 8; columns < 200; ++columns) {
    EXPECT_LE(client::progress_line("setpoints", 1, 3, columns).size(), columns);
  }
}

}  // namespace
}  // namespace kcs::cli
