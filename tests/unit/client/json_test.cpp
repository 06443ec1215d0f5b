#include "client/cli/json.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace kcs::cli {
namespace {

using nlohmann::json;

TEST(Json, PlanCarriesTheSummaryUnderTheNamesOfTheContract) {
  client::Plan plan;
  plan.name = "plans/ab";
  plan.options.machine.axes = 2;
  plan.options.strategy = client::CornerStrategy::kExactStop;
  plan.summary.cycle_time_s = 12.5;
  plan.summary.segment_count = 7;
  plan.summary.blended_count = 4;
  plan.summary.overlapping_count = 2;
  plan.summary.max_jerk_mm_s3 = {1e5, 2e5};
  plan.notices = {{3, "M7 has no effect", 2}};

  const json object = json::parse(plan_json(plan));
  for (const char* key :
       {"path_length_mm", "corner_count", "max_contour_error_mm", "max_feed_mm_s", "max_velocity_mm_s",
        "max_acceleration_mm_s2", "time_at_feed_s", "time_lost_at_corners_s", "start_mm", "end_mm"}) {
    EXPECT_TRUE(object.contains(key)) << key;
  }
  EXPECT_EQ(object["name"], "plans/ab");
  EXPECT_EQ(object["cycle_time_s"], 12.5);
  EXPECT_EQ(object["segment_count"], 7);
  EXPECT_EQ(object["blended_count"], 4);
  EXPECT_EQ(object["overlapping_count"], 2);
  EXPECT_EQ(object["max_jerk_mm_s3"], json({1e5, 2e5}));
  EXPECT_EQ(object["options"]["strategy"], "exact-stop");
  EXPECT_EQ(object["notices"][0]["line"], 3);
  EXPECT_EQ(object["notices"][0]["text"], "M7 has no effect");
}

TEST(Json, NumbersKeepAllTheirDigits) {
  client::Plan plan;
  plan.summary.cycle_time_s = 0.1 + 0.2;
  EXPECT_EQ(json::parse(plan_json(plan))["cycle_time_s"].get<double>(), 0.1 + 0.2);
}

TEST(Json, CornersAreAnArrayOfObjects) {
  client::Corner corner;
  corner.segment = 4;
  corner.line = 12;
  corner.angle_deg = 90;
  corner.strategy = client::CornerStrategy::kUninterrupted;
  corner.speed_mm_s = 46.058;
  client::Corner other = corner;
  other.strategy = client::CornerStrategy::kOverlapping;
  const json array = json::parse(corners_json({corner, other}));
  ASSERT_EQ(array.size(), 2);
  EXPECT_EQ(array[0]["segment"], 4);
  EXPECT_EQ(array[0]["line"], 12);
  EXPECT_EQ(array[0]["angle_deg"], 90.0);
  EXPECT_EQ(array[0]["strategy"], "uninterrupted");
  EXPECT_EQ(array[1]["strategy"], "overlapping");
  EXPECT_EQ(array[0]["speed_mm_s"], 46.058);
  for (const char* key : {"boundary_acceleration_mm_s2", "duration_s", "deviation_mm", "time_lost_s"}) {
    EXPECT_TRUE(array[1].contains(key)) << key;
  }
}

TEST(Json, NoCornersAreAnEmptyArray) { EXPECT_EQ(json::parse(corners_json({})), json::array()); }

}  // namespace
}  // namespace kcs::cli
