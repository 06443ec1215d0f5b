// SIGTERM: what a kcsd still does, and how its clients go on with another one.
#include <signal.h>

#include <chrono>
#include <string>
#include <vector>

#include "tests/system/shared_store.h"
#include "tests/system/test_kcsd.h"

namespace kcs::test {
namespace {

using std::chrono::seconds;
using std::chrono::steady_clock;

// Beyond its grace it takes this long at the most.
constexpr seconds kFarewell{4};
constexpr std::uint32_t kBatch = 10;
constexpr double kPeriod = 0.01;

std::string with_grace(seconds grace, const std::string& store) {
  return fmt::format("[server]\ngrace_s = {}.0\n{}", grace.count(), store);
}

v1::StreamSetpointsRequest paced(const std::string& name) {
  v1::StreamSetpointsRequest request = setpoints(name, kPeriod);
  request.set_batch_size(kBatch);
  request.set_lead_s(0.2);
  return request;
}

// A stream that is read while its server stops.
class Reading {
 public:
  Reading(TestKcsd& kcsd, const v1::StreamSetpointsRequest& request)
      : reader_(kcsd.stub().StreamSetpoints(&call_, request)) {}

  bool read() {
    v1::SetpointBatch batch;
    if (!reader_->Read(&batch)) return false;
    batches_.push_back(batch.SerializeAsString());
    ended_ = batch.end_of_path();
    return true;
  }
  grpc::Status read_to_the_end() {
    while (read()) continue;
    return reader_->Finish();
  }

  const std::vector<std::string>& batches() const { return batches_; }
  bool ended() const { return ended_; }

 private:
  Call call_;
  std::unique_ptr<grpc::ClientReader<v1::SetpointBatch>> reader_;
  std::vector<std::string> batches_;
  bool ended_ = false;
};

// Told to stop at construction.
class Stopping {
 public:
  explicit Stopping(TestKcsd& kcsd) : kcsd_(kcsd) { kcsd_.process().send_signal(SIGTERM); }

  // Both on a connection that is open already and on a new one.
  void expect_new_calls_refused() {
    grpc::Status refused;
    EXPECT_TRUE(eventually([&] {
      refused = kcsd_.get("plans/none").status;
      return refused.error_code() == grpc::StatusCode::UNAVAILABLE;
    }));
    EXPECT_TRUE(is_unavailable_for_a_while(refused));
    EXPECT_TRUE(is_unavailable_for_a_while(kcsd_.create(request_of(9)).status));
    EXPECT_TRUE(is_unavailable_for_a_while(kcsd_.create(accept_only(request_of(9))).status));
    EXPECT_TRUE(is_unavailable_for_a_while(kcsd_.stream(setpoints("plans/none", 1)).status));
    EXPECT_TRUE(is_unavailable_for_a_while(TestClient(new_channel(kcsd_.address())).list().status));
    EXPECT_EQ(kcsd_.page("/readyz").status, 503);
  }

  void expect_end(seconds grace) {
    EXPECT_EQ(kcsd_.process().wait(), 0) << kcsd_.process().errors();
    EXPECT_LT(steady_clock::now() - began_, grace + kFarewell);
  }

 private:
  TestKcsd& kcsd_;
  steady_clock::time_point began_ = steady_clock::now();
};

class Sigterm : public ::testing::Test {
 protected:
  // A plan of more than five seconds, or of many minutes.
  static v1::Plan create(TestKcsd& kcsd, int moves) {
    const auto plan = kcsd.create(request_of(1, moves));
    EXPECT_TRUE(plan.status.ok()) << plan.status.error_message();
    return plan.message;
  }

  PostgresqlStore store_;
};

TEST_F(Sigterm, LetsAPacedStreamFinishWithinTheGraceWhileNewCallsAreRefused) {
  constexpr seconds kGrace{40};
  TestKcsd kcsd(with_grace(kGrace, store_.settings()));
  const v1::Plan plan = create(kcsd, 20);
  auto whole = setpoints(plan.name(), kPeriod);
  whole.set_batch_size(kBatch);
  const auto expected = kcsd.stream(whole);
  Reading reading(kcsd, paced(plan.name()));
  ASSERT_TRUE(reading.read());
  Stopping stopping(kcsd);
  stopping.expect_new_calls_refused();
  EXPECT_FALSE(reading.ended());
  const grpc::Status status = reading.read_to_the_end();
  EXPECT_TRUE(status.ok()) << status.error_message();
  EXPECT_EQ(reading.batches(), bytes(expected.message));
  stopping.expect_end(seconds(10));  // long before the grace is over
}

TEST_F(Sigterm, EndsAStreamThatOutlastsTheGraceSoThatItGoesOnElsewhere) {
  constexpr seconds kGrace{1};
  TestKcsd one(with_grace(kGrace, store_.settings()));
  TestKcsd other(with_grace(kGrace, store_.settings()));
  const v1::Plan plan = create(one, 1000);
  ASSERT_GT(plan.summary().cycle_time_s(), 200);
  Reading reading(one, paced(plan.name()));
  ASSERT_TRUE(reading.read());
  Stopping stopping(one);
  const grpc::Status status = reading.read_to_the_end();
  EXPECT_TRUE(is_unavailable_for_a_while(status));
  EXPECT_FALSE(reading.ended());
  stopping.expect_end(kGrace);

  v1::StreamSetpointsRequest rest = setpoints(plan.name(), kPeriod);
  rest.set_batch_size(kBatch);
  const auto expected = other.stream(rest);
  rest.set_first_index(reading.batches().size() * kBatch);
  const auto resumed = other.stream(rest);
  EXPECT_TRUE(resumed.status.ok()) << resumed.status.error_message();
  std::vector<std::string> joined = reading.batches();
  const std::vector<std::string> rest_of_it = bytes(resumed.message);
  joined.insert(joined.end(), rest_of_it.begin(), rest_of_it.end());
  EXPECT_EQ(joined.size(), expected.message.size());
  EXPECT_TRUE(joined == bytes(expected.message));
}

TEST_F(Sigterm, EndsACallThatWaitsForItsPlanAndAnUploadThatDoesNotEnd) {
  constexpr seconds kGrace{1};
  TestKcsd kcsd(with_grace(kGrace, store_.settings()));
  const auto accepted = kcsd.create(accept_only(request_of(1, 900'000 / 10)));
  ASSERT_TRUE(accepted.status.ok()) << accepted.status.error_message();
  v1::WatchPlanRequest watched;
  watched.set_name(accepted.message.name());
  Call watching;
  const auto watcher = kcsd.stub().WatchPlan(&watching, watched);
  Call uploading;
  v1::Plan plan;
  const auto upload = kcsd.stub().CreatePlan(&uploading, &plan);
  upload->Write(request_of(2)[0]);
  v1::PlanProgress progress;
  ASSERT_TRUE(watcher->Read(&progress));
  Stopping stopping(kcsd);
  while (watcher->Read(&progress)) continue;
  const grpc::Status status = watcher->Finish();
  EXPECT_TRUE(progress.state() == v1::PLAN_STATE_READY ? status.ok() : is_unavailable_for_a_while(status));
  EXPECT_FALSE(upload->Finish().ok());
  stopping.expect_end(kGrace);
}

}  // namespace
}  // namespace kcs::test
