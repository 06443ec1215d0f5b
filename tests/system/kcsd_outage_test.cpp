// The database of a kcsd goes, and comes back.
#include <signal.h>

#include <chrono>
#include <string>
#include <vector>

#include "tests/system/shared_store.h"
#include "tests/system/test_kcsd.h"

namespace kcs::test {
namespace {

constexpr const char* kService = "kcs.v1.PlanningService";

::testing::AssertionResult is_ready(const TestKcsd& kcsd) {
  const TestKcsd::Page page = kcsd.page("/readyz");
  if (page.status == 200 && kcsd.is_serving() == true && kcsd.is_serving(kService) == true) {
    return ::testing::AssertionSuccess();
  }
  return ::testing::AssertionFailure() << page.status << " " << page.text;
}

::testing::AssertionResult is_not_ready_and_says_why(const TestKcsd& kcsd) {
  const TestKcsd::Page page = kcsd.page("/readyz");
  if (page.status == 503 && page.text.find("the store is not reached") != std::string::npos &&
      kcsd.is_serving() == false && kcsd.is_serving(kService) == false && kcsd.page("/healthz").status == 200) {
    return ::testing::AssertionSuccess();
  }
  return ::testing::AssertionFailure() << page.status << " " << page.text;
}

// Every way to a plan that is kept.
std::vector<grpc::Status> all_ways(TestKcsd& kcsd, const std::string& name) {
  return {kcsd.create(request_of(77)).status,
          kcsd.create(accept_only(request_of(78))).status,
          kcsd.get(name).status,
          kcsd.list().status,
          kcsd.remove(name),
          kcsd.stream(setpoints(name, 0.01)).status,
          kcsd.corners(name).status,
          kcsd.watch(name).status};
}

class Outage : public ::testing::Test {
 protected:
  PostgresqlStore store_;
};

TEST_F(Outage, IsToldWhileStreamsGoOnAndAllIsWellAfterwards) {
  TestKcsd kcsd(store_.settings());
  ASSERT_TRUE(eventually([&] { return is_ready(kcsd); }));
  const v1::Plan plan = kcsd.create(request_of(1)).message;
  ASSERT_GT(plan.summary().cycle_time_s(), 4);
  const auto expected = kcsd.stream(setpoints(plan.name(), 0.01));
  auto paced = setpoints(plan.name(), 0.01);
  paced.set_lead_s(0.1);
  paced.set_batch_size(10);
  Call call;
  const auto reader = kcsd.stub().StreamSetpoints(&call, paced);
  v1::SetpointBatch batch;
  ASSERT_TRUE(reader->Read(&batch));

  store_.server().stop();
  for (const grpc::Status& status : all_ways(kcsd, plan.name())) EXPECT_TRUE(is_unavailable_for_a_while(status));
  EXPECT_TRUE(eventually([&] { return is_not_ready_and_says_why(kcsd); })) << is_not_ready_and_says_why(kcsd).message();
  std::uint64_t next = 10;
  while (reader->Read(&batch)) {
    EXPECT_EQ(batch.first_index(), next);
    next += static_cast<std::uint64_t>(batch.position_mm(0).values_size());
  }
  EXPECT_TRUE(reader->Finish().ok());
  EXPECT_EQ(next, batch.setpoint_count());
  EXPECT_TRUE(is_not_ready_and_says_why(kcsd)) << "it was over too soon to tell";

  store_.server().start();
  EXPECT_TRUE(eventually([&] { return is_ready(kcsd); })) << is_ready(kcsd).message();
  EXPECT_EQ(kcsd.get(plan.name()).message.SerializeAsString(), plan.SerializeAsString());
  EXPECT_EQ(bytes(kcsd.stream(setpoints(plan.name(), 0.01)).message), bytes(expected.message));
  EXPECT_EQ(kcsd.list_all().message.size(), 1U) << "what was answered UNAVAILABLE was kept";
  EXPECT_TRUE(kcsd.create(request_of(77)).status.ok());
}

TEST_F(Outage, DoesNotLoseWhatWasAcceptedBefore) {
  constexpr int kManyMoves = 12'000;
  TestKcsd kcsd(store_.settings());
  const auto accepted = kcsd.create(accept_only(request_of(1, kManyMoves)));
  ASSERT_TRUE(accepted.status.ok()) << accepted.status.error_message();
  store_.server().kill();
  // It is made meanwhile, but cannot be written down.
  EXPECT_TRUE(
      eventually([&] { return kcsd.page("/metrics").text.find("\nkcs_plans_running 0\n") != std::string::npos; }));
  store_.server().start();
  EXPECT_EQ(kcsd.wait_until_ready(accepted.message.name()).summary().segment_count(),
            static_cast<std::uint64_t>(kManyMoves));
}

TEST_F(Outage, AtTheStartIsWaitedFor) {
  store_.server().stop();
  TestKcsd kcsd(store_.settings());
  EXPECT_TRUE(is_not_ready_and_says_why(kcsd));
  for (const grpc::Status& status : all_ways(kcsd, "plans/none")) EXPECT_TRUE(is_unavailable_for_a_while(status));
  store_.server().start();
  EXPECT_TRUE(eventually([&] { return is_ready(kcsd); })) << is_ready(kcsd).message();
  EXPECT_TRUE(kcsd.create(request_of(1)).status.ok());
}

TEST_F(Outage, DoesNotHoldUpTheEnd) {
  std::string patient = store_.settings();  // a call of the database is given up after 40 s
  patient.replace(patient.find("timeout_s = 1.0"), 15, "timeout_s = 10.0");
  TestKcsd kcsd(patient);
  ASSERT_TRUE(kcsd.create(request_of(1)).status.ok());
  store_.server().freeze();
  kcsd.process().send_signal(SIGTERM);
  const auto began = std::chrono::steady_clock::now();
  EXPECT_EQ(kcsd.process().wait(), 0) << kcsd.process().errors();
  EXPECT_LT(std::chrono::steady_clock::now() - began, std::chrono::seconds(10));
  store_.server().thaw();
}

}  // namespace
}  // namespace kcs::test
