// The client library's live planning, against a real server on a loopback socket.
#include "client/sdk/live_stream.h"

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <sstream>
#include <stop_token>
#include <string>
#include <thread>

#include "client/sdk/planner.h"
#include "server/service/server.h"

namespace kcs::client {
namespace {

class LiveStreamTest : public testing::Test {
 protected:
  static PlanOptions options() {
    return {.machine = {.axes = 2,
                        .velocity_mm_s = {500, 500},
                        .acceleration_mm_s2 = {2500, 2500},
                        .jerk_mm_s3 = {2e5, 2e5}},
            .feed_mm_s = 100};
  }

  // Round and round in chords of 0.1 mm.
  static PointPath circle(int first, int count) {
    PointPath path;
    for (int i = first; i < first + count; ++i) {
      path.points_mm.insert(path.points_mm.end(), {10 * std::cos(i * 0.01), 10 * std::sin(i * 0.01)});
    }
    return path;
  }

  static std::vector<double> read_all(LiveStream& stream) {
    std::vector<double> x;
    for (SetpointBatch batch; stream.next(batch);) {
      EXPECT_EQ(batch.first_index, x.size());
      x.insert(x.end(), batch.position_mm[0].begin(), batch.position_mm[0].end());
      EXPECT_EQ(batch.setpoint_count, batch.end_of_path ? x.size() : 0);
    }
    return x;
  }

  // The code of the Error that ends the stream.
  static std::string code_at_end(LiveStream& stream) {
    try {
      read_all(stream);
    } catch (const Error& error) {
      return error.code();
    }
    return "no error";
  }

  service::Server server_{{.listen = "127.0.0.1:0", .planning_threads = 1, .store = {.database = "memory"}}};
  Planner planner_{server_.address()};
};

TEST_F(LiveStreamTest, GivesTheSameAsAStoredPlan) {
  const Plan stored = planner_.plan_points(circle(0, 20'000), options());
  auto setpoints = planner_.stream_setpoints(stored.name, {.period_s = 0.001});
  std::vector<double> expected;
  for (SetpointBatch batch; setpoints.next(batch);) {
    expected.insert(expected.end(), batch.position_mm[0].begin(), batch.position_mm[0].end());
  }

  LiveStream stream = planner_.plan_live(options(), {.period_s = 0.001, .corners = true});
  std::jthread sender([&] {
    EXPECT_TRUE(stream.send(circle(0, 15'000)));
    EXPECT_TRUE(stream.send(circle(15'000, 5'000)));
    stream.end_path();
  });
  EXPECT_EQ(read_all(stream), expected);
  EXPECT_EQ(stream.plan().name, stored.name);
  EXPECT_EQ(stream.plan().summary.cycle_time_s, stored.summary.cycle_time_s);
  EXPECT_EQ(stream.take_corners().size(), stored.summary.corner_count);
  EXPECT_TRUE(stream.take_corners().empty());
  SetpointBatch batch;
  EXPECT_FALSE(stream.next(batch)) << "it stays ended";
}

TEST_F(LiveStreamTest, TakesGcode) {
  const std::string text = "G1 X10 Y0\nX10 Y10\nG2 X20 Y20 I10 J0\n";
  std::istringstream program(text);
  const Plan stored = planner_.plan_gcode(program, options());
  LiveStream stream = planner_.plan_live(options(), {.channels = {Channel::kJerk}, .batch_size = 10});
  for (const char character : text) EXPECT_TRUE(stream.send(std::string_view(&character, 1)));
  stream.end_path();
  SetpointBatch batch;
  ASSERT_TRUE(stream.next(batch));
  EXPECT_LE(batch.size(), 10);
  EXPECT_EQ(batch.jerk_mm_s3.size(), 2);
  EXPECT_TRUE(batch.velocity_mm_s.empty());
  while (stream.next(batch)) continue;
  EXPECT_TRUE(batch.end_of_path);
  EXPECT_EQ(stream.plan().name, stored.name);
}

TEST_F(LiveStreamTest, SpeedsAtTheEndsArriveThereAndComeBack) {
  PlanOptions moving = options();
  moving.start_speed_mm_s = 30;
  moving.start_acceleration_mm_s2 = 100;
  moving.end_speed_mm_s = 20;
  LiveStream stream = planner_.plan_live(moving, {.channels = {Channel::kVelocity}});
  stream.send(PointPath{.points_mm = {0, 0, 20, 0}});
  stream.end_path();
  SetpointBatch batch;
  ASSERT_TRUE(stream.next(batch));
  EXPECT_EQ(batch.velocity_mm_s[0].front(), 30);
  while (stream.next(batch)) continue;
  EXPECT_EQ(batch.velocity_mm_s[0].back(), 20);
  EXPECT_EQ(stream.plan().options.start_speed_mm_s, 30);
  EXPECT_EQ(stream.plan().options.start_acceleration_mm_s2, 100);
  EXPECT_EQ(stream.plan().options.end_speed_mm_s, 20);
}

TEST_F(LiveStreamTest, RefusalsEndBothDirections) {
  LiveStream stream = planner_.plan_live(options(), {});
  stream.send(PointPath{.points_mm = {0, 0, 1, 0, 1, NAN}});
  const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(20);
  while (stream.send(circle(0, 1))) ASSERT_LT(std::chrono::steady_clock::now(), deadline) << "it is still taken";
  try {
    read_all(stream);
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), "INVALID_ARGUMENT");
    ASSERT_EQ(error.violations().size(), 1);
    EXPECT_EQ(error.violations()[0].field, "path.points_mm, segment 1");
  }
}

TEST_F(LiveStreamTest, OptionsThatCannotBeServedAreRefused) {
  LiveStream stream = planner_.plan_live(options(), {.period_s = 0});
  EXPECT_EQ(code_at_end(stream), "INVALID_ARGUMENT");
}

TEST_F(LiveStreamTest, ArraysThatDoNotFitThePointsAreRefused) {
  LiveStream stream = planner_.plan_live(options(), {});
  EXPECT_THROW(stream.send(PointPath{.points_mm = {0, 0, 1, 0, 1, 1}, .feed_mm_s = {1, 2}}), Error);
}

TEST_F(LiveStreamTest, AStopEndsItFromAnotherThread) {
  std::stop_source stop;
  LiveStream stream = planner_.plan_live(options(), {}, stop.get_token());
  stream.send(circle(0, 5'000));
  std::jthread stopper([&stop] {
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
    stop.request_stop();
  });
  EXPECT_EQ(code_at_end(stream), "CANCELLED");
}

TEST_F(LiveStreamTest, CanBeLeftHalfWay) {
  for (int i = 0; i < 20; ++i) {
    LiveStream stream = planner_.plan_live(options(), {.period_s = 1e-4});
    stream.send(circle(0, 5'000));
    SetpointBatch batch;
    EXPECT_TRUE(stream.next(batch));
  }
}

}  // namespace
}  // namespace kcs::client
