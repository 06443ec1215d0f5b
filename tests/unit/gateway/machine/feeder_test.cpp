#include "client/gateway/machine/feeder.h"

#include <gtest/gtest.h>

#include <deque>
#include <random>

#include "tests/unit/gateway/machine/bench.h"
#include "tests/unit/gateway/machine/command_judge.h"
#include "tests/unit/gateway/machine/straight_server.h"

namespace kcs::gateway {
namespace {

constexpr const char* kRun = "machines/bench/runs/7";
constexpr double kLength = 200;  // mm
constexpr double kPeriod = 0.001;
constexpr double kWindow = 0.25;
constexpr int kPatience = 60'000;  // ticks

using Orders = std::vector<v1::AttachMachineResponse>;

class FeederTest : public testing::Test {
 protected:
  void deliver(const Orders& orders) {
    for (const auto& order : orders) bench_.feeder().take(order);
  }
  // Server and machine for some ticks, over a network that takes no time.
  void play(int ticks) {
    for (int i = 0; i < ticks; ++i) {
      if (i % 10 == 0) deliver(server_.react(report()));
      bench_.tick();
    }
  }
  void play_until_state(v1::MachineState state) {
    for (int i = 0; i < kPatience && report().state() != state; ++i) play(1);
    ASSERT_EQ(report().state(), state);
  }
  void play_to_the_end() {
    for (int i = 0; i < kPatience && !report().run_finished(); i += 10) play(10);
    ASSERT_TRUE(report().run_finished()) << report().ShortDebugString();
    bench_.tick(5);
  }
  v1::MachineReport report() { return bench_.feeder().report(); }
  std::string violation() const { return find_violation(bench_.commands, test_profile(), kLength); }

  v1::AttachMachineResponse command(v1::MachineCommand command) const {
    v1::AttachMachineResponse order;
    order.set_command(command);
    return order;
  }

  Bench bench_;
  StraightServer server_{kRun, kLength, kPeriod, kWindow};
};

TEST_F(FeederTest, PlaysARunToItsExactEnd) {
  play_to_the_end();
  EXPECT_EQ(violation(), "");
  EXPECT_EQ(report().run().run(), kRun);
  EXPECT_EQ(report().run().branch(), 0u);
  EXPECT_EQ(report().run().ticks_played(), StraightMotion(0, kLength, kPeriod).size());
  EXPECT_EQ(report().run().end().plan_time_s(), kLength);
  EXPECT_EQ(report().counters().starvations(), 0u);
  EXPECT_EQ(report().state(), v1::MACHINE_STATE_READY);
}

TEST_F(FeederTest, HandsThePlayerNoMoreThanIsDue) {
  play(300);
  const v1::RunPosition position = report().run();
  EXPECT_LE(position.ticks_committed() - position.ticks_played(), 60u + StraightServer::kBatch);
  EXPECT_GE(position.ticks_held() - position.ticks_played(), 200u);
  EXPECT_EQ(position.batch_ends(0).tick(), position.ticks_committed());
  EXPECT_EQ(position.batch_ends(position.batch_ends_size() - 1).tick(), position.ticks_held());
}

TEST_F(FeederTest, BeginsOnlyWithEnoughMotionToGoOn) {
  const StraightMotion motion(0, kLength, kPeriod);
  deliver(server_.react(report()));  // the start
  v1::AttachMachineResponse order;
  *order.mutable_batch() = motion.batch(kRun, 0, 0, 0, 20);
  deliver({order});
  bench_.tick(100);
  EXPECT_EQ(report().run().ticks_played(), 0u);
  *order.mutable_batch() = motion.batch(kRun, 0, 20, 20, 20);
  deliver({order});
  bench_.tick(20);
  EXPECT_GT(report().run().ticks_played(), 0u);
}

TEST_F(FeederTest, HoldIsObeyedWithinABatchAndResumedWhereItRests) {
  play(400);
  const std::uint64_t asked_at = bench_.commands.size();
  deliver({server_.hold()});
  while (bench_.player().state == KCS_PLAYER_RUNNING) bench_.tick();
  EXPECT_LE(bench_.commands.size() - asked_at, StraightServer::kBatch + 1);
  play_until_state(v1::MACHINE_STATE_HELD);
  const v1::RunPosition position = report().run();
  EXPECT_EQ(position.branch(), 1u);
  EXPECT_EQ(position.ticks_held(), position.ticks_played());
  EXPECT_EQ(position.end().rate(), 0);
  EXPECT_EQ(StraightMotion::point(position.end().plan_time_s()), bench_.commands.back());
  EXPECT_EQ(report().fault(), "");
  server_.resume();
  play_to_the_end();
  EXPECT_EQ(violation(), "");
}

TEST_F(FeederTest, HoldBeforeTheFirstSetpointLetsNothingBegin) {
  deliver(server_.react(report()));
  deliver(server_.react(report()));  // the window
  bench_.feeder().step();            // committed, not begun yet
  deliver({server_.hold()});
  bench_.tick(200);
  EXPECT_EQ(bench_.commands.back(), StraightMotion::point(0));
  EXPECT_EQ(report().state(), v1::MACHINE_STATE_HELD);
  EXPECT_EQ(report().run().ticks_held(), 0u);
  server_.resume();
  play_to_the_end();
  EXPECT_EQ(violation(), "");
}

TEST_F(FeederTest, AbortEndsTheRunAtRestOnThePath) {
  play(400);
  deliver({command(v1::MACHINE_COMMAND_ABORT)});
  bench_.tick(2);
  EXPECT_TRUE(report().has_run()) << "still moving";
  for (int i = 0; i < kPatience && report().has_run(); ++i) bench_.tick();
  EXPECT_EQ(report().state(), v1::MACHINE_STATE_READY);
  EXPECT_EQ(find_violation(bench_.commands, test_profile(), bench_.commands.back().norm()), "");
}

// The server has it forget a run that is over, and somebody asks for the next one.
TEST_F(FeederTest, StartThatFollowsAnAbortAtOnceBegins) {
  deliver({command(v1::MACHINE_COMMAND_ABORT)});
  play_to_the_end();
  EXPECT_EQ(report().fault(), "");
  EXPECT_EQ(violation(), "");
}

TEST_F(FeederTest, StarvationIsTold) {
  play(400);
  bench_.tick(2000);
  EXPECT_EQ(report().state(), v1::MACHINE_STATE_HELD);
  EXPECT_EQ(report().counters().starvations(), 1u);
  EXPECT_NE(report().fault().find("no batch"), std::string::npos) << report().fault();
  play_to_the_end();
  EXPECT_EQ(report().fault(), "");
  EXPECT_EQ(violation(), "");
}

TEST_F(FeederTest, StartElsewhereIsRefusedWithBothPlaces) {
  v1::AttachMachineResponse order;
  order.mutable_start()->set_name(kRun);
  order.mutable_start()->add_position_mm(0);
  order.mutable_start()->add_position_mm(0.25);
  deliver({order});
  EXPECT_EQ(report().run().run(), kRun);
  EXPECT_NE(report().fault().find("stands at 0 mm on axis Y, and the plan starts at 0.25 mm"), std::string::npos)
      << report().fault();
  EXPECT_EQ(report().state(), v1::MACHINE_STATE_READY);
  deliver({command(v1::MACHINE_COMMAND_ABORT)});
  bench_.tick(8);
  EXPECT_FALSE(report().has_run());
  EXPECT_EQ(report().fault(), "");
}

TEST_F(FeederTest, StartIsRefusedWhileTheDrivesAreOff) {
  bench_.input.enable = false;
  bench_.tick(8);
  v1::AttachMachineResponse order;
  order.mutable_start()->set_name(kRun);
  deliver({order});
  EXPECT_NE(report().fault().find("off"), std::string::npos) << report().fault();
  EXPECT_EQ(report().state(), v1::MACHINE_STATE_SWITCHED_OFF);
}

TEST_F(FeederTest, NumberOfARunIsNotUsedTwice) {
  play_to_the_end();
  v1::AttachMachineResponse order;
  order.mutable_start()->set_name(kRun);
  order.mutable_start()->set_plan("plans/another");
  for (const double place : {bench_.commands.back().x(), bench_.commands.back().y()}) {
    order.mutable_start()->add_position_mm(place);
  }
  deliver({order});
  EXPECT_NE(report().fault().find("needs a new number"), std::string::npos) << report().fault();
  EXPECT_FALSE(report().run_finished());
  order.mutable_start()->set_name("machines/bench/runs/8");
  deliver({order});
  EXPECT_EQ(report().fault(), "");
  EXPECT_EQ(report().run().run(), "machines/bench/runs/8");
  EXPECT_FALSE(report().run_finished());
}

TEST_F(FeederTest, StartThatIsSaidTwiceIsTheSameRun) {
  play(400);
  v1::AttachMachineResponse order;
  order.mutable_start()->set_name(kRun);
  order.mutable_start()->set_plan("plans/straight");
  deliver({order});
  play_to_the_end();
  EXPECT_EQ(report().run().branch(), 0u);
  EXPECT_EQ(violation(), "");
}

TEST_F(FeederTest, DriveFaultEndsTheRunUntilItIsSwitchedOffAndOn) {
  play(400);
  bench_.input.drive_fault = true;
  play_until_state(v1::MACHINE_STATE_FAULT);
  EXPECT_NE(report().fault().find("drive reports a fault"), std::string::npos) << report().fault();
  bench_.input.drive_fault = false;
  play(100);
  EXPECT_EQ(report().state(), v1::MACHINE_STATE_FAULT);
  bench_.input.enable = false;
  bench_.tick(8);
  bench_.input.enable = true;
  play(100);
  EXPECT_EQ(report().state(), v1::MACHINE_STATE_READY);
  EXPECT_NE(report().fault(), "") << "stays to be read until the server ends the run";
  deliver({command(v1::MACHINE_COMMAND_ABORT)});
  bench_.tick(8);
  EXPECT_FALSE(report().has_run());
}

TEST_F(FeederTest, FollowingErrorIsAFault) {
  play(300);
  bench_.stuck = true;
  play_until_state(v1::MACHINE_STATE_FAULT);
  EXPECT_NE(report().fault().find("did not follow"), std::string::npos) << report().fault();
}

TEST_F(FeederTest, BatchThatThePlayerRefusesToBeginWithIsNotTriedForEver) {
  deliver(server_.react(report()));
  v1::AttachMachineResponse order;
  *order.mutable_batch() = StraightMotion(1, kLength, kPeriod).batch(kRun, 0, 0, 0, 80);  // starts 1 mm away
  deliver({order});
  bench_.tick(200);
  EXPECT_EQ(report().state(), v1::MACHINE_STATE_HELD);
  EXPECT_EQ(report().run().ticks_held(), 0u);
  EXPECT_EQ(report().counters().refused_batches(), 1u);
  EXPECT_NE(report().fault(), "");
  play_to_the_end();  // the server resumes it
  EXPECT_EQ(violation(), "");
}

TEST_F(FeederTest, AnotherGatewayGoesOnWhereTheMachineRests) {
  play(400);
  bench_.feeds = false;  // kill -9
  bench_.tick(2000);
  EXPECT_EQ(bench_.player().state, KCS_PLAYER_HELD);
  bench_.replace_gateway();
  bench_.feeds = true;
  EXPECT_EQ(report().run().run(), kRun);
  EXPECT_EQ(report().run().branch(), 1u);
  EXPECT_EQ(StraightMotion::point(report().run().end().plan_time_s()), bench_.commands.back());
  server_.restart();
  play_to_the_end();
  EXPECT_EQ(violation(), "");
}

TEST_F(FeederTest, GatewayThatComesBackInMidMotionStopsFirst) {
  play(400);
  bench_.replace_gateway();
  play_until_state(v1::MACHINE_STATE_HELD);
  server_.restart();
  play_to_the_end();
  EXPECT_EQ(violation(), "");
}

TEST_F(FeederTest, ShuttingDownBringsTheMachineToRestAndBeginsNothing) {
  play(400);
  bench_.feeder().shut_down();
  EXPECT_FALSE(bench_.feeder().at_rest());
  play(3000);
  EXPECT_TRUE(bench_.feeder().at_rest());
  EXPECT_EQ(find_violation(bench_.commands, test_profile(), bench_.commands.back().norm()), "");
  EXPECT_LT(bench_.commands.back().norm(), kLength);
}

// A network that delays, loses whole connections, repeats, swaps and damages what the server sends.
class BadNetwork {
 public:
  explicit BadNetwork(unsigned seed) : random_(seed) {}

  bool happens(double probability) { return std::bernoulli_distribution(probability)(random_); }

  void send(const Orders& orders, std::size_t now) {
    for (v1::AttachMachineResponse order : orders) {
      if (order.has_batch() && happens(0.005)) damage(*order.mutable_batch());
      under_way_.push_back({now + delay_, order});
      if (order.has_batch() && happens(0.01)) under_way_.push_back({now + delay_, order});
      if (under_way_.size() >= 2 && order.has_batch() && happens(0.005)) {
        std::swap(under_way_.back().second, under_way_[under_way_.size() - 2].second);
      }
    }
  }
  void lose_all() { under_way_.clear(); }
  void change_delay() { delay_ = std::uniform_int_distribution<std::size_t>(0, happens(0.1) ? 400 : 30)(random_); }

  Orders arrive(std::size_t now) {
    Orders orders;
    for (; !under_way_.empty() && under_way_.front().first <= now; under_way_.pop_front()) {
      orders.push_back(std::move(under_way_.front().second));
    }
    return orders;
  }

 private:
  void damage(v1::MotionBatch& batch) {
    double& value = *batch.mutable_position_mm(0)->mutable_values()->begin();
    value = happens(0.5) ? value + 1 : 1e300;
    if (happens(0.3)) batch.set_checksum(batch.checksum() + 1);
  }

  std::mt19937 random_;
  std::size_t delay_ = 5;
  std::deque<std::pair<std::size_t, v1::AttachMachineResponse>> under_way_;
};

class FeederOnABadNetwork : public FeederTest, public testing::WithParamInterface<unsigned> {};

TEST_P(FeederOnABadNetwork, EveryRunIsTravelledOnceInsideTheLimits) {
  BadNetwork network(GetParam());
  std::size_t cut_until = 0;
  for (std::size_t now = 0; now < kPatience && !server_.finished(); ++now) {
    const bool cut = now < cut_until;
    if (!cut && now % 20 == 0) network.send(server_.react(report()), now);
    if (!cut && network.happens(0.0005)) network.send({server_.hold()}, now);
    if (report().state() == v1::MACHINE_STATE_HELD && network.happens(0.02)) server_.resume();
    if (network.happens(0.002)) network.change_delay();
    if (network.happens(0.0005)) {
      cut_until = now + (network.happens(0.5) ? 100 : 2000);
      network.lose_all();
      server_.reconnect();
    }
    deliver(network.arrive(now));
    bench_.tick();
  }
  ASSERT_TRUE(server_.finished()) << report().ShortDebugString();
  bench_.tick(5);
  EXPECT_EQ(violation(), "");
}

INSTANTIATE_TEST_SUITE_P(Seeds, FeederOnABadNetwork, testing::Range(0u, 200u));

}  // namespace
}  // namespace kcs::gateway
