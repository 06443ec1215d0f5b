// The client library against a real server on a loopback socket.
#include "client/sdk/planner.h"

#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <sstream>
#include <stop_token>
#include <string>
#include <thread>

#include "server/service/server.h"

namespace kcs::client {
namespace {

class PlannerTest : public testing::Test {
 protected:
  static service::ServerOptions server_options() {
    service::ServerOptions options;
    options.store.database = "memory";
    options.listen = "127.0.0.1:0";
    options.planning_threads = 1;
    return options;
  }

  static PlanOptions options() {
    PlanOptions options;
    options.machine = {.name = "table",
                       .axes = 2,
                       .velocity_mm_s = {500, 500},
                       .acceleration_mm_s2 = {2500, 2500},
                       .jerk_mm_s3 = {2e5, 2e5},
                       .rapid_mm_s = {}};
    options.feed_mm_s = 100;
    return options;
  }

  service::Server server_{server_options()};
  Planner planner_{server_.address()};
};

// The paper's example (section 3.1): 46.058 mm/s and 0.28999 s for two legs of 10 mm at a right angle.
TEST_F(PlannerTest, PlansPoints) {
  PlanOptions paper = options();
  paper.tolerance_mm = 0.1;
  paper.tolerance_kind = ToleranceKind::kCornerDistance;
  paper.strategy = CornerStrategy::kUninterrupted;
  const Plan plan = planner_.plan_points({.points_mm = {0, 0, 10, 0, 10, 10}}, paper);
  EXPECT_NEAR(plan.summary.cycle_time_s, 0.28999, 0.0003);
  EXPECT_EQ(plan.summary.segment_count, 2);
  EXPECT_EQ(plan.options.machine.name, "table");
  EXPECT_EQ(plan.options.strategy, CornerStrategy::kUninterrupted);
  const std::vector<Corner> corners = planner_.corners(plan.name);
  ASSERT_EQ(corners.size(), 1);
  EXPECT_NEAR(corners[0].speed_mm_s, 46.058, 0.05);
  EXPECT_EQ(corners[0].strategy, CornerStrategy::kUninterrupted);
  EXPECT_EQ(corners[0].point_mm, (std::vector<double>{10, 0}));
}

TEST_F(PlannerTest, ListsPlansPageByPage) {
  std::vector<std::string> made;
  for (const double length : {10.0, 20.0, 30.0}) {
    made.insert(made.begin(), planner_.plan_points({.points_mm = {0, 0, length, 0}}, options()).name);
  }
  const PlanPage first = planner_.list({}, {}, 2);
  ASSERT_EQ(first.plans.size(), 2);
  EXPECT_EQ(first.plans[0].name, made[0]);
  EXPECT_EQ(first.plans[1].name, made[1]);
  EXPECT_GE(first.plans[0].create_time, first.plans[1].create_time);
  EXPECT_EQ(first.plans[0].state, PlanState::kReady);
  EXPECT_GT(first.plans[0].summary.cycle_time_s, 0.3);
  const PlanPage last = planner_.list({}, first.next_page_token, 2);
  ASSERT_EQ(last.plans.size(), 1);
  EXPECT_EQ(last.plans[0].name, made[2]);
  EXPECT_EQ(last.next_page_token, "");

  EXPECT_EQ(planner_.list({.cycle_time_at_least_s = first.plans[1].summary.cycle_time_s}).plans.size(), 2);
  EXPECT_EQ(planner_.list({.machine_name = "another"}).plans.size(), 0);
  EXPECT_EQ(planner_.list({.state = PlanState::kRefused}).plans.size(), 0);
  EXPECT_EQ(planner_.list({.created_before = last.plans[0].create_time}).plans.size(), 0);
  EXPECT_THROW(planner_.list({.state = PlanState::kReady}, first.next_page_token), Error);
}

TEST_F(PlannerTest, AwaitsWhatWasAcceptedOnly) {
  PlanOptions later = options();
  later.accept_only = true;
  later.priority = Priority::kBatch;
  PointPath zigzag;
  for (int i = 0; i < 4000; ++i) {
    zigzag.points_mm.push_back(i % 2 == 0 ? 0 : 3);
    zigzag.points_mm.push_back(i);
  }
  const Plan accepted = planner_.plan_points(zigzag, later);
  EXPECT_NE(accepted.state, PlanState::kReady) << "4,000 corners take longer than the answer";
  PlanProgress last;
  const Plan plan = planner_.await(accepted.name, [&last](const PlanProgress& progress) {
    EXPECT_GE(progress.segments_planned, last.segments_planned);
    last = progress;
  });
  EXPECT_EQ(last.state, PlanState::kReady);
  EXPECT_EQ(last.segments_planned, 3999);
  EXPECT_EQ(plan.name, accepted.name);
  EXPECT_EQ(plan.state, PlanState::kReady);
  EXPECT_GT(plan.summary.cycle_time_s, 100);
}

TEST_F(PlannerTest, StrategiesArriveThereAndComeBack) {
  PlanOptions asked = options();
  asked.tolerance_kind = ToleranceKind::kCornerDistance;
  for (const CornerStrategy strategy : {CornerStrategy::kInterrupted, CornerStrategy::kUninterrupted,
                                        CornerStrategy::kBlended, CornerStrategy::kExactStop}) {
    asked.strategy = strategy;
    const Plan plan = planner_.plan_points({.points_mm = {0, 0, 10, 0, 10, 10}}, asked);
    EXPECT_EQ(plan.options.strategy, strategy);
    EXPECT_EQ(planner_.corners(plan.name).at(0).strategy, strategy);
    const Summary& summary = plan.summary;
    EXPECT_EQ(summary.interrupted_count, strategy == CornerStrategy::kInterrupted);
    EXPECT_EQ(summary.uninterrupted_count, strategy == CornerStrategy::kUninterrupted);
    EXPECT_EQ(summary.blended_count, strategy == CornerStrategy::kBlended);
    EXPECT_EQ(summary.exact_stop_count, strategy == CornerStrategy::kExactStop);
  }
}

TEST_F(PlannerTest, CornersNearToEachOtherAreReportedAsOverlapping) {
  PointPath path;  // a parabola in chords of a tenth of a millimetre
  for (int i = -50; i <= 50; ++i) path.points_mm.insert(path.points_mm.end(), {i * 0.1, i * i * 0.0005});
  const Plan plan = planner_.plan_points(path, options());
  EXPECT_EQ(plan.options.strategy, CornerStrategy::kAuto);
  const std::vector<Corner> corners = planner_.corners(plan.name);
  const auto overlapping = std::count_if(corners.begin(), corners.end(), [](const Corner& corner) {
    return corner.strategy == CornerStrategy::kOverlapping;
  });
  EXPECT_GT(overlapping, 0);
  EXPECT_EQ(plan.summary.overlapping_count, overlapping);
}

TEST_F(PlannerTest, OverlappingCannotBeAskedFor) {
  PlanOptions bad = options();
  bad.strategy = CornerStrategy::kOverlapping;
  try {
    planner_.plan_points({.points_mm = {0, 0, 10, 0}}, bad);
    FAIL();
  } catch (const Error& error) {
    ASSERT_EQ(error.violations().size(), 1);
    EXPECT_EQ(error.violations()[0].field, "options.strategy");
  }
}

TEST_F(PlannerTest, PathsOfManyMessagesKeepWhatBelongsToTheirPoints) {
  PointPath path;
  for (int i = 0; i < 20'000; ++i) {
    path.points_mm.insert(path.points_mm.end(), {i * 10.0, i % 2 * 10.0});
    path.line.push_back(static_cast<std::uint32_t>(i + 1));
  }
  path.stops = {{.point = 10'000, .dwell_s = 2}};
  const Plan plan = planner_.plan_points(path, options());
  EXPECT_EQ(plan.summary.segment_count, 19'999);
  EXPECT_EQ(plan.summary.dwell_time_s, 2);
  const std::vector<Corner> corners = planner_.corners(plan.name);
  ASSERT_EQ(corners.size(), 19'998);
  EXPECT_EQ(corners[9'999].dwell_s, 2);
  EXPECT_EQ(corners[9'999].line, 10'001);
  EXPECT_EQ(corners.back().line, 19'999);
}

TEST_F(PlannerTest, GcodeIsTheSamePlanAsItsPoints) {
  std::istringstream program("G1 X10 Y0\nX10 Y10\n");
  const Plan plan = planner_.plan_gcode(program, options());
  EXPECT_EQ(plan.summary.segment_count, 2);
  EXPECT_DOUBLE_EQ(plan.summary.cycle_time_s,
                   planner_.plan_points({.points_mm = {0, 0, 10, 0, 10, 10}}, options()).summary.cycle_time_s);
}

TEST_F(PlannerTest, RefusalsCarryCodeAndViolations) {
  PlanOptions bad = options();
  bad.machine.jerk_mm_s3[1] = -1;
  try {
    planner_.plan_points({.points_mm = {0, 0, 10, 0}}, bad);
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), "INVALID_ARGUMENT");
    ASSERT_EQ(error.violations().size(), 1);
    EXPECT_EQ(error.violations()[0].field, "options.machine.jerk_mm_s3[1]");
    EXPECT_FALSE(error.violations()[0].description.empty());
  }
}

TEST_F(PlannerTest, ArraysThatDoNotFitThePointsAreRefused) {
  EXPECT_THROW(planner_.plan_points({.points_mm = {0, 0, 1, 0, 1, 1}, .feed_mm_s = {1, 2}}, options()), Error);
  EXPECT_THROW(planner_.plan_points({.points_mm = {0, 0, 1, 0}, .stops = {{.point = 2}}}, options()), Error);
}

TEST_F(PlannerTest, PlansAreKeptUntilRemoved) {
  const std::string name = planner_.plan_points({.points_mm = {0, 0, 10, 0}}, options()).name;
  EXPECT_EQ(planner_.get(name).name, name);
  planner_.remove(name);
  try {
    planner_.get(name);
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), "NOT_FOUND");
  }
}

TEST_F(PlannerTest, StreamsGiveEverySetpointOnceAndResume) {
  const Plan plan = planner_.plan_points({.points_mm = {0, 0, 100, 0}}, options());
  auto stream = planner_.stream_setpoints(plan.name, {.period_s = 0.001, .batch_size = 100});
  std::vector<double> x;
  SetpointBatch batch;
  while (stream.next(batch)) {
    EXPECT_EQ(batch.first_index, x.size());
    EXPECT_LE(batch.size(), 100);
    x.insert(x.end(), batch.position_mm[0].begin(), batch.position_mm[0].end());
  }
  EXPECT_FALSE(stream.next(batch)) << "it stays ended";
  EXPECT_TRUE(batch.end_of_path);
  EXPECT_EQ(batch.setpoint_count, x.size());
  EXPECT_EQ(x.back(), 100);

  auto again =
      planner_.stream_setpoints(plan.name, {.period_s = 0.001, .first_index = 333, .channels = {Channel::kJerk}});
  ASSERT_TRUE(again.next(batch));
  EXPECT_EQ(batch.first_index, 333);
  EXPECT_EQ(batch.position_mm[0], std::vector<double>(x.begin() + 333, x.end()));
  EXPECT_EQ(batch.jerk_mm_s3.size(), 2);
  EXPECT_TRUE(batch.velocity_mm_s.empty());
}

TEST_F(PlannerTest, StreamsSayHowFarAlongThePathTheToolIs) {
  const Plan plan = planner_.plan_points({.points_mm = {0, 0, 3, 4, 3, 10}, .line = {1, 8, 5}}, options());
  auto stream =
      planner_.stream_setpoints(plan.name, {.channels = {Channel::kPathPosition, Channel::kSegment, Channel::kLine}});
  SetpointBatch batch;
  ASSERT_TRUE(stream.next(batch));
  ASSERT_EQ(batch.path_position_mm.size(), batch.size());
  ASSERT_EQ(batch.segment.size(), batch.size());
  EXPECT_EQ(batch.path_position_mm.front(), 0);
  EXPECT_EQ(batch.path_position_mm.back(), 11);
  EXPECT_EQ(batch.segment.front(), 0);
  EXPECT_EQ(batch.segment.back(), 1);
  ASSERT_EQ(batch.line.size(), batch.size());
  EXPECT_EQ(batch.line.front(), 8);
  EXPECT_EQ(batch.line.back(), 5);
}

TEST_F(PlannerTest, StreamsComeAtThePaceThatIsAskedFor) {
  const Plan plan = planner_.plan_points({.points_mm = {0, 0, 20, 0}}, options());
  const auto began = std::chrono::steady_clock::now();
  auto stream = planner_.stream_setpoints(plan.name, {.period_s = 0.01, .last_index = 20, .lead_s = 0.05});
  SetpointBatch batch;
  ASSERT_TRUE(stream.next(batch));
  EXPECT_EQ(batch.size(), 10) << "a tenth of a second";
  while (stream.next(batch)) continue;
  EXPECT_EQ(batch.first_index, 20);
  EXPECT_GE(std::chrono::steady_clock::now() - began, std::chrono::milliseconds(150));
}

TEST_F(PlannerTest, StreamsCanBeLeftHalfWay) {
  const Plan plan = planner_.plan_points({.points_mm = {0, 0, 100'000, 0}}, options());
  for (int i = 0; i < 20; ++i) {
    auto stream = planner_.stream_setpoints(plan.name, {.period_s = 1e-4});
    SetpointBatch batch;
    EXPECT_TRUE(stream.next(batch));
  }
  EXPECT_EQ(planner_.get(plan.name).name, plan.name);
}

// The code of the Error that `call` throws.
template <typename Call>
std::string code_of(Call call) {
  try {
    call();
  } catch (const Error& error) {
    return error.code();
  }
  return "no error";
}

TEST_F(PlannerTest, AStopEndsAStreamFromAnotherThread) {
  const Plan plan = planner_.plan_points({.points_mm = {0, 0, 100'000, 0}}, options());
  std::stop_source stop;
  auto stream = planner_.stream_setpoints(plan.name, {.period_s = 1e-5, .batch_size = 1}, stop.get_token());
  std::jthread stopper([&stop] { stop.request_stop(); });
  EXPECT_EQ(code_of([&stream] {
              for (SetpointBatch batch; stream.next(batch);) {
              }
            }),
            "CANCELLED");
}

TEST_F(PlannerTest, AStopEndsAPlanningFromAnotherThread) {
  PointPath path;  // takes seconds to plan
  for (int i = 0; i < 100'000; ++i) path.points_mm.insert(path.points_mm.end(), {i * 10.0, i % 2 * 10.0});
  std::stop_source stop;
  std::jthread stopper([&stop] {
    std::this_thread::sleep_for(std::chrono::milliseconds(200));
    stop.request_stop();
  });
  EXPECT_EQ(code_of([&] { planner_.plan_points(path, options(), stop.get_token()); }), "CANCELLED");
}

TEST_F(PlannerTest, ACallThatIsStoppedBeforeItBeginsDoesNotBegin) {
  std::stop_source stop;
  stop.request_stop();
  std::istringstream program("G1 X10 Y0\nX10 Y10\n");
  EXPECT_EQ(code_of([&] { planner_.plan_gcode(program, options(), stop.get_token()); }), "CANCELLED");
  EXPECT_EQ(code_of([&] { planner_.get("plans/x", stop.get_token()); }), "CANCELLED");
}

TEST_F(PlannerTest, AStopEndsTheWaitForAServerThatDoesNotAnswer) {
  // Takes connections, and says nothing.
  const int listener = ::socket(AF_INET, SOCK_STREAM, 0);
  sockaddr_in address{.sin_family = AF_INET, .sin_port = 0, .sin_addr = {htonl(INADDR_LOOPBACK)}, .sin_zero = {}};
  socklen_t size = sizeof(address);
  ASSERT_EQ(::bind(listener, reinterpret_cast<sockaddr*>(&address), size), 0);
  ASSERT_EQ(::listen(listener, 1), 0);
  ASSERT_EQ(::getsockname(listener, reinterpret_cast<sockaddr*>(&address), &size), 0);
  Planner planner("127.0.0.1:" + std::to_string(ntohs(address.sin_port)), std::chrono::minutes(1));
  std::stop_source stop;
  std::jthread stopper([&stop] {
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
    stop.request_stop();
  });
  const auto begin = std::chrono::steady_clock::now();
  EXPECT_EQ(code_of([&] { planner.get("plans/x", stop.get_token()); }), "CANCELLED");
  EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(5));
  ::close(listener);
}

TEST_F(PlannerTest, AServerThatIsNotThereIsAnError) {
  const std::string address = server_.address();
  server_.stop(std::chrono::milliseconds(0));
  Planner planner(address);
  try {
    planner.get("plans/x");
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), "UNAVAILABLE");
    EXPECT_EQ(std::string(error.what()),
              "no kcsd answers at " + address + "; start one with: kcsd --listen " + address);
  }
}

}  // namespace
}  // namespace kcs::client
