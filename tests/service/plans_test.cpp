// CreatePlan, GetPlan, DeletePlan: what a plan says, and what it is called.
#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <string>
#include <vector>

#include "tests/service/test_server.h"

namespace kcs::service::test {
namespace {

constexpr std::string_view kProgram =
    "(a square with a rounded corner)\n"
    "G21 G90 G64 P0.02\n"
    "F3000\n"
    "G1 X40\n"
    "Y30\n"
    "G3 X30 Y40 I-10\n"
    "G1 X0\n"
    "Y0 Z-1\n"
    "M30\n";

class Plans : public ::testing::Test {
 protected:
  TestServer server_;
};

TEST_F(Plans, PathOfPointsInTwoAxesIsPlanned) {
  const auto plan = server_.create({request(options()), request(right_angle())});
  ASSERT_TRUE(plan.status.ok()) << plan.status.error_message();
  const v1::PlanSummary& summary = plan.message.summary();
  EXPECT_EQ(plan.message.name().find("plans/"), 0U);
  EXPECT_EQ(plan.message.name().size(), 6U + 64U);
  EXPECT_EQ(plan.message.name().find_first_not_of("0123456789abcdef", 6), std::string::npos);
  EXPECT_DOUBLE_EQ(summary.path_length_mm(), 20);
  EXPECT_EQ(summary.segment_count(), 2U);
  EXPECT_EQ(summary.corner_count(), 1U);
  EXPECT_EQ(summary.interrupted_count() + summary.uninterrupted_count() + summary.blended_count() +
                summary.overlapping_count() + summary.exact_stop_count(),
            1U);
  EXPECT_GT(summary.phase_count(), 0U);
  EXPECT_EQ(summary.max_velocity_mm_s_size(), 2);
  EXPECT_EQ(summary.max_acceleration_mm_s2_size(), 2);
  EXPECT_EQ(summary.max_jerk_mm_s3_size(), 2);
  EXPECT_LE(summary.max_contour_error_mm(), 0.01);
  EXPECT_EQ(std::vector<double>(summary.start_mm().begin(), summary.start_mm().end()), (std::vector<double>{0, 0}));
  EXPECT_EQ(std::vector<double>(summary.end_mm().begin(), summary.end_mm().end()), (std::vector<double>{10, 10}));
}

TEST_F(Plans, PathOfPointsInThreeAxesIsPlanned) {
  const auto plan = server_.create({request(options(3)), request(path({0, 0, 0, 10, 0, 5, 10, 10, -5}))});
  ASSERT_TRUE(plan.status.ok()) << plan.status.error_message();
  EXPECT_EQ(plan.message.summary().max_velocity_mm_s_size(), 3);
  EXPECT_EQ(plan.message.summary().end_mm(2), -5);
}

TEST_F(Plans, GcodeIsPlannedFromItsStart) {
  v1::PlanOptions from = options(3);
  for (const double coordinate : {1.0, 2.0, 3.0}) from.add_start_mm(coordinate);
  const auto plan = server_.create({request(from), gcode(kProgram)});
  ASSERT_TRUE(plan.status.ok()) << plan.status.error_message();
  EXPECT_EQ(plan.message.summary().start_mm(1), 2);
  EXPECT_EQ(plan.message.summary().end_mm(2), -1);
  EXPECT_GT(plan.message.summary().max_chord_error_mm(), 0);
  EXPECT_GT(plan.message.summary().segment_count(), 5U);
}

TEST_F(Plans, NoticesTellWhatHadNoEffect) {
  const auto plan = server_.create({request(options(3)), gcode("T1 M6\nG1 X10 F600\nT1 M6\nX0\n")});
  ASSERT_TRUE(plan.status.ok()) << plan.status.error_message();
  ASSERT_GT(plan.message.notices_size(), 0);
  EXPECT_EQ(plan.message.notices(0).line(), 1U);
  EXPECT_EQ(plan.message.notices(0).count(), 2U);
  EXPECT_FALSE(plan.message.notices(0).text().empty());
}

TEST_F(Plans, OptionsComeBackWithTheirDefaults) {
  v1::PlanOptions asked = options(3);
  asked.mutable_machine()->set_name("Fräse 1");
  const v1::PlanOptions used = server_.create({request(asked), gcode(kProgram)}).message.options();
  EXPECT_EQ(used.machine().name(), "Fräse 1");
  EXPECT_EQ(used.machine().axes(), 3U);
  EXPECT_EQ(used.machine().jerk_mm_s3(2), 2e5);
  EXPECT_FALSE(used.machine().has_rapid_mm_s());
  EXPECT_EQ(used.tolerance_mm(), 0.01);
  EXPECT_EQ(used.tolerance_kind(), v1::TOLERANCE_KIND_CONTOUR_ERROR);
  EXPECT_EQ(used.strategy(), v1::CORNER_STRATEGY_AUTO);
  EXPECT_FALSE(used.has_feed_mm_s());
  EXPECT_EQ(used.start_mm_size(), 3);
  const auto points = server_.create({request(options()), request(right_angle())});
  EXPECT_TRUE(points.message.options().start_mm().empty());
}

TEST_F(Plans, FeedOfTheOptionsReplacesTheProgrammedOnes) {
  v1::PlanOptions slow = options();
  slow.set_feed_mm_s(5);
  v1::PathChunk path = right_angle();
  path.clear_feed_mm_s();
  const auto plan = server_.create({request(slow), request(path)});
  ASSERT_TRUE(plan.status.ok()) << plan.status.error_message();
  EXPECT_NEAR(plan.message.summary().max_feed_mm_s(), 5, 1e-9);
  EXPECT_EQ(plan.message.name(), server_.create({request(slow), request(right_angle())}).message.name());
}

TEST_F(Plans, StopsAndDwellsAreTaken) {
  v1::PathChunk path = right_angle();
  for (const auto& [point, dwell] : {std::pair{0U, 0.25}, {1U, 0.5}, {2U, 1.0}}) {
    v1::Stop& stop = *path.add_stops();
    stop.set_point(point);
    stop.set_dwell_s(dwell);
  }
  const auto plan = server_.create({request(options()), request(path)});
  ASSERT_TRUE(plan.status.ok()) << plan.status.error_message();
  EXPECT_DOUBLE_EQ(plan.message.summary().dwell_time_s(), 1.75);
  EXPECT_EQ(plan.message.summary().exact_stop_count(), 1U);
  const auto plain = server_.create({request(options()), request(right_angle())});
  EXPECT_GT(plan.message.summary().cycle_time_s(), plain.message.summary().cycle_time_s() + 1.75);
}

TEST_F(Plans, NameAndPlanDoNotDependOnHowPointsAreCut) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> coordinate(-50, 50);
  constexpr int kPoints = 200;
  v1::PathChunk whole;
  for (int i = 0; i < kPoints; ++i) {
    for (int axis = 0; axis < 3; ++axis) whole.add_points_mm(coordinate(random));
    whole.add_feed_mm_s(20 + i % 3);
    whole.add_tolerance_mm(0.02);
    whole.add_line(static_cast<std::uint32_t>(i + 1));
    if (i % 50 == 7) whole.add_stops()->set_point(static_cast<std::uint32_t>(i));
  }
  const auto expected = server_.create({request(options(3)), request(whole)});
  ASSERT_TRUE(expected.status.ok()) << expected.status.error_message();
  ASSERT_TRUE(server_.remove(expected.message.name()).ok());

  std::vector<v1::CreatePlanRequest> pieces = {request(options(3))};
  for (int first = 0; first < kPoints;) {
    const int size = std::min<int>(kPoints - first, static_cast<int>(random() % 40));
    v1::PathChunk piece;
    for (int i = first; i < first + size; ++i) {
      for (int axis = 0; axis < 3; ++axis) piece.add_points_mm(whole.points_mm(i * 3 + axis));
      piece.add_feed_mm_s(whole.feed_mm_s(i));
      piece.add_line(whole.line(i));
      if (i % 50 == 7) piece.add_stops()->set_point(static_cast<std::uint32_t>(i - first));
    }
    if (size > 0) piece.add_tolerance_mm(0.02);
    pieces.push_back(request(piece));
    first += size;
  }
  const auto cut = server_.create(pieces);
  ASSERT_TRUE(cut.status.ok()) << cut.status.error_message();
  EXPECT_EQ(content(cut.message), content(expected.message));
}

TEST_F(Plans, NameAndPlanDoNotDependOnHowGcodeIsCut) {
  const auto expected = server_.create({request(options(3)), gcode(kProgram)});
  ASSERT_TRUE(expected.status.ok()) << expected.status.error_message();
  for (const std::size_t size : {std::size_t{1}, std::size_t{7}, kProgram.size() - 1}) {
    std::vector<v1::CreatePlanRequest> pieces = {request(options(3))};
    for (std::size_t i = 0; i < kProgram.size(); i += size) pieces.push_back(gcode(kProgram.substr(i, size)));
    ASSERT_TRUE(server_.remove(expected.message.name()).ok());
    EXPECT_EQ(content(server_.create(pieces).message), content(expected.message)) << size;
  }
}

TEST_F(Plans, SameRequestHasTheSameNameAndAnotherOneAnother) {
  const auto name_of = [this](const v1::PlanOptions& options, const v1::PathChunk& path) {
    const auto plan = server_.create({request(options), request(path)});
    EXPECT_TRUE(plan.status.ok()) << plan.status.error_message();
    return plan.message.name();
  };
  const std::string name = name_of(options(), right_angle());
  EXPECT_EQ(name_of(options(), right_angle()), name);
  v1::PlanOptions spelt_out = options();
  spelt_out.set_tolerance_mm(0.01);
  spelt_out.set_strategy(v1::CORNER_STRATEGY_AUTO);
  spelt_out.set_tolerance_kind(v1::TOLERANCE_KIND_CONTOUR_ERROR);
  EXPECT_EQ(name_of(spelt_out, right_angle()), name);
  EXPECT_EQ(name_of(options(), path({-0.0, 0, 10, -0.0, 10, 10})), name);

  v1::PlanOptions other = options();
  other.set_tolerance_mm(0.02);
  EXPECT_NE(name_of(other, right_angle()), name);
  EXPECT_NE(name_of(options(), path({0, 0, 10, 0, 10, 10.000001})), name);
  EXPECT_NE(name_of(options(), path({0, 0, 10, 0, 10, 10}, 99)), name);
  v1::PathChunk lines = right_angle();
  for (const std::uint32_t line : {1, 2, 3}) lines.add_line(line);
  EXPECT_NE(name_of(options(), lines), name);
}

TEST_F(Plans, KeptPlanIsFoundUntilItIsDeleted) {
  const auto plan = server_.create({request(options()), request(right_angle())});
  const std::string name = plan.message.name();
  EXPECT_EQ(server_.get(name).message.SerializeAsString(), plan.message.SerializeAsString());
  EXPECT_TRUE(server_.remove(name).ok());
  EXPECT_EQ(server_.get(name).status.error_code(), grpc::StatusCode::NOT_FOUND);
  EXPECT_EQ(server_.remove(name).error_code(), grpc::StatusCode::NOT_FOUND);
  EXPECT_EQ(server_.stream(setpoints(name, 0.001)).status.error_code(), grpc::StatusCode::NOT_FOUND);
  EXPECT_EQ(server_.corners(name).status.error_code(), grpc::StatusCode::NOT_FOUND);
  EXPECT_EQ(server_.create({request(options()), request(right_angle())}).message.name(), name);
  EXPECT_TRUE(server_.get(name).status.ok());
}

TEST_F(Plans, InProcessChannelReachesTheSamePlans) {
  const std::string name = server_.create({request(options()), request(right_angle())}).message.name();
  const auto stub = v1::PlanningService::NewStub(server_.server().in_process_channel());
  Call call;
  v1::GetPlanRequest message;
  message.set_name(name);
  v1::Plan plan;
  EXPECT_TRUE(stub->GetPlan(&call, message, &plan).ok());
  EXPECT_EQ(plan.name(), name);
}

TEST(PlanningThreads, DoNotChangeAByteOfAPlan) {
  std::string bytes;
  for (const std::size_t threads : {1, 2}) {
    TestServer server({.planning_threads = threads});
    const auto plan = server.create({request(options(3)), gcode(kProgram)});
    ASSERT_TRUE(plan.status.ok()) << plan.status.error_message();
    std::string these = content(plan.message);
    auto all = setpoints(plan.message.name(), 0.001);
    for (const auto channel : {v1::CHANNEL_VELOCITY, v1::CHANNEL_ACCELERATION, v1::CHANNEL_JERK}) {
      all.add_channels(channel);
    }
    for (const auto& batch : server.stream(all).message) these += batch.SerializeAsString();
    if (bytes.empty()) bytes = these;
    EXPECT_EQ(these, bytes);
  }
}

}  // namespace
}  // namespace kcs::service::test
