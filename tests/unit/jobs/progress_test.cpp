// What those see who look on while a plan is made.
#include <gtest/gtest.h>

#include <chrono>
#include <optional>

#include "server/jobs/plan_cache.h"
#include "server/jobs/plan_desk.h"
#include "tests/unit/jobs/requests.h"

namespace kcs::jobs {
namespace {

using State = Progress::State;
using std::chrono::milliseconds;
using test::endless;
using test::large;
using test::right_angle;

constexpr milliseconds kDeadline{60'000};

struct Office {
  PlanCache plans{1000, 1 << 30};
  PlanDesk desk{plans, {.threads = 1, .queue_length = 100, .client_waiting = 100, .client_running = 1}};
};

TEST(Progress, RisesFromTheFirstSegmentToTheLast) {
  Office office;
  const Ticket ticket = office.desk.submit(large("plans/a"), "anna", Priority::kNormal);
  Progress last = ticket.progress();
  EXPECT_EQ(last.segment_count, 20'002U);
  bool seen_on_the_way = false;
  while (!last.over()) {
    const Progress now = ticket.wait_for_change(last, kDeadline);
    ASSERT_NE(now, last);
    EXPECT_GE(now.state, last.state);
    EXPECT_GE(now.segments_planned, last.segments_planned);
    seen_on_the_way = seen_on_the_way || (now.segments_planned > 0 && !now.over());
    last = now;
  }
  EXPECT_EQ(last.state, State::kDone);
  EXPECT_EQ(last.segments_planned, 20'002U);
  EXPECT_TRUE(seen_on_the_way);
}

TEST(Progress, TellsHowManyRequestsGoFirst) {
  Office office;
  std::optional<Ticket> first = office.desk.submit(endless("plans/a"), "anna", Priority::kInteractive);
  while (first->progress().state != State::kPlanning) first->wait_for_change(first->progress(), kDeadline);
  std::optional<Ticket> second = office.desk.submit(endless("plans/b"), "anna", Priority::kNormal);
  const Ticket third = office.desk.submit(right_angle("plans/c"), "anna", Priority::kNormal);
  Progress progress = third.progress();
  EXPECT_EQ(progress.state, State::kWaiting);
  EXPECT_EQ(progress.requests_ahead, 2U);
  first.reset();
  second.reset();
  while (!progress.over()) {
    progress = third.wait_for_change(progress, kDeadline);
    EXPECT_LE(progress.requests_ahead, 1U);
  }
  EXPECT_EQ(progress.requests_ahead, 0U);
}

TEST(Progress, OfWhatIsKeptIsThatItIsDone) {
  Office office;
  const Ticket first = office.desk.submit(right_angle("plans/a"), "anna", Priority::kNormal);
  ASSERT_TRUE(first.wait(kDeadline));
  const Ticket again = office.desk.submit(right_angle("plans/a"), "anna", Priority::kNormal);
  const Progress progress = again.progress();
  EXPECT_EQ(progress.state, State::kDone);
  EXPECT_EQ(progress.segments_planned, 2U);
  EXPECT_EQ(progress.segment_count, 2U);
  EXPECT_EQ(again.plan(), first.plan());
}

TEST(Progress, WaitingForAChangeEndsWithoutOne) {
  Office office;
  const Ticket ticket = office.desk.submit(right_angle("plans/a"), "anna", Priority::kNormal);
  ASSERT_TRUE(ticket.wait(kDeadline));
  const Progress last = ticket.progress();
  EXPECT_EQ(ticket.wait_for_change(last, milliseconds(1)), last);
}

}  // namespace
}  // namespace kcs::jobs
