#include "server/runs/run_feed.h"

#include <gtest/gtest.h>

#include "server/planning/plan_path.h"

namespace kcs::runs {
namespace {

class RunFeedTest : public ::testing::Test {
 protected:
  static planning::PlanOptions machine() {
    return {.limits = {.axes = 2,
                       .velocity = motion::Vector::Constant(500),
                       .acceleration = motion::Vector::Constant(2000),
                       .jerk = motion::Vector::Constant(1e5)}};
  }
  static planning::Plan line() {
    planning::Toolpath path;
    path.segments.push_back({.end = {100, 0, 0}, .feed = 100, .tolerance = 0.01});
    return planning::plan(path, machine());
  }

  // Takes all that the feed gives now.
  std::vector<NumberedBatch> take() {
    std::vector<NumberedBatch> batches;
    while (auto batch = feed_.next()) {
      ends_.push_back({batch->begin.tick + batch->batch.positions.size(), batch->batch.end});
      batches.push_back(*std::move(batch));
    }
    return batches;
  }
  MachinePosition at(std::uint64_t played, std::uint64_t committed) const {
    MachinePosition position{.played = played, .committed = committed};
    for (const BatchEnd& end : ends_) {
      if (end.tick >= played) position.ends.push_back(end);
    }
    return position;
  }

  const planning::Plan plan_ = line();
  RunFeed feed_{plan_, machine().limits, {.window = 250, .margin = 40}};
  std::vector<BatchEnd> ends_ = {BatchEnd{}};
};

TEST_F(RunFeedTest, KeepsTheWindowFull) {
  feed_.go_on_from({.ends = {BatchEnd{}}});
  EXPECT_EQ(take().size(), 13);  // 260 setpoints: a batch more than the window
  EXPECT_TRUE(take().empty());
  feed_.update(at(20, 60));
  EXPECT_EQ(take().size(), 1);
}

TEST_F(RunFeedTest, ReplacesWhatIsNotWithThePlayerWhenThePaceChanges) {
  feed_.go_on_from({.ends = {BatchEnd{}}});
  take();
  feed_.update(at(40, 100));
  take();
  feed_.set_rate(0.5);
  const auto replaced = take();
  ASSERT_FALSE(replaced.empty());
  EXPECT_EQ(replaced.front().begin.tick, 140) << "committed and the margin";
  EXPECT_LT(replaced.front().batch.end.rate, 1);
}

TEST_F(RunFeedTest, ReplacesAgainWithMoreTimeWhatCameTooLate) {
  feed_.go_on_from({.ends = {BatchEnd{}}});
  take();
  feed_.update(at(40, 100));
  take();
  const std::vector<BatchEnd> held = ends_;
  feed_.set_rate(0.5);
  take();
  ends_ = held;  // the machine was at 140 already when that came
  feed_.go_on_from(at(80, 160));
  feed_.update(at(80, 160));
  const auto replaced = take();
  ASSERT_FALSE(replaced.empty());
  EXPECT_EQ(replaced.front().begin.tick, 240) << "committed and twice the margin";
  EXPECT_LT(replaced.front().batch.end.rate, 1);
}

TEST_F(RunFeedTest, PausesWhenTheMachineHasLeftTheStream) {
  feed_.go_on_from({.ends = {BatchEnd{}}});
  take();
  feed_.update({.branch = 1, .played = 90, .committed = 90, .ends = {{90, {0.05, 0, 0}}}});
  EXPECT_TRUE(take().empty());
  EXPECT_EQ(feed_.plan_time(), 0.05);
  feed_.go_on_from({.branch = 1, .played = 90, .committed = 90, .ends = {{90, {0.05, 0, 0}}}});
  const auto batches = take();
  ASSERT_FALSE(batches.empty());
  EXPECT_EQ(batches.front().branch, 1);
  EXPECT_EQ(batches.front().begin.tick, 90);
  EXPECT_EQ(batches.front().begin.clock.plan_time, 0.05);
}

}  // namespace
}  // namespace kcs::runs
