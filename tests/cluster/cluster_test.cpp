// Servers that come and go behind the balancer, and clients that see one service.
#include "tests/cluster/cluster.h"

#include <gtest/gtest.h>

#include <functional>
#include <map>
#include <mutex>
#include <random>
#include <stop_token>
#include <string_view>
#include <thread>

#include "client/sdk/error.h"
#include "client/sdk/planner.h"
#include "tests/cluster/jobs.h"

namespace kcs::test {
namespace {

using client::Planner;
using std::chrono::milliseconds;

constexpr int kClients = 4;

// What clients were told, and what must not be.
class Ledger {
 public:
  void acknowledge(const client::Plan& plan) {
    const std::lock_guard lock(mutex_);
    cycle_times_[plan.name] = plan.summary.cycle_time_s;
  }
  void streamed(const std::string& plan, std::size_t digest) {
    const std::lock_guard lock(mutex_);
    const auto [it, is_new] = digests_.try_emplace(plan, digest);
    if (!is_new) ++streamed_again_;
    if (it->second != digest) faults_.push_back(plan + " has other setpoints now");
  }
  void fault(const std::string& what) {
    const std::lock_guard lock(mutex_);
    faults_.push_back(what);
  }
  std::string any(std::uint64_t number) {
    const std::lock_guard lock(mutex_);
    return cycle_times_.empty() ? "" : std::next(cycle_times_.begin(), number % cycle_times_.size())->first;
  }
  // When no client works any more.
  const std::map<std::string, double>& cycle_times() const { return cycle_times_; }
  const std::map<std::string, std::size_t>& digests() const { return digests_; }
  const std::vector<std::string>& faults() const { return faults_; }
  int streamed_again() const { return streamed_again_; }

 private:
  std::mutex mutex_;
  std::map<std::string, double> cycle_times_;
  std::map<std::string, std::size_t> digests_;
  std::vector<std::string> faults_;
  int streamed_again_ = 0;
};

// Of all setpoints, each of which must come once and in order. With pauses it lasts long enough to be in the way of
// whatever happens to the servers.
std::size_t digest_of(Planner& planner, const std::string& plan, milliseconds pause) {
  client::SetpointStream stream = planner.stream_setpoints(
      plan, {.period_s = 1e-4, .channels = {client::Channel::kVelocity, client::Channel::kJerk}, .batch_size = 2048});
  std::size_t digest = 0;
  std::uint64_t next = 0;
  for (client::SetpointBatch batch; stream.next(batch);) {
    EXPECT_EQ(batch.first_index, next);
    next += batch.size();
    for (const std::vector<double>& column : batch.position_mm) {
      const std::string_view bytes(reinterpret_cast<const char*>(column.data()), column.size() * sizeof(double));
      digest = digest * 31 + std::hash<std::string_view>()(bytes);
    }
    std::this_thread::sleep_for(pause);
  }
  return digest;
}

void work(const std::string& address, std::uint64_t seed, Ledger& ledger, const std::stop_token& stop) {
  Planner planner({.address = address, .patience = std::chrono::minutes(1)});
  std::mt19937_64 random(seed);
  while (!stop.stop_requested()) {
    try {
      ledger.acknowledge(planner.plan_points(corners(random(), 200, 10), job_options()));
      const std::string plan = ledger.any(random());
      ledger.streamed(plan, digest_of(planner, plan, milliseconds(20)));
    } catch (const client::Error& error) {
      ledger.fault(error.code() + ": " + error.what());
    }
  }
}

class ClusterTest : public testing::Test {
 protected:
  void SetUp() override {
    if (const auto missing = Cluster::missing()) GTEST_SKIP() << *missing;
    cluster_.emplace(4);
    for (std::size_t place = 0; place < 3; ++place) cluster_->start(place);
  }

  std::optional<Cluster> cluster_;
};

TEST_F(ClusterTest, LosesNoPlanAndBreaksNoStreamWhileServersAreKilledAddedAndDrained) {
  Ledger ledger;
  std::mt19937_64 random(5);
  const auto wait = [&random] {
    std::this_thread::sleep_for(milliseconds(std::uniform_int_distribution<int>(300, 1200)(random)));
  };
  std::vector<std::jthread> clients;
  for (int i = 0; i < kClients; ++i) {
    clients.emplace_back(
        [&, seed = random()](const std::stop_token& stop) { work(cluster_->address(), seed, ledger, stop); });
  }
  for (std::size_t place : {1, 0, 2}) {
    wait();
    cluster_->kill(place);
    wait();
    cluster_->start(place);
  }
  wait();
  cluster_->start(3);
  wait();
  EXPECT_EQ(cluster_->drain(1), 0);
  wait();
  for (std::jthread& client : clients) client.request_stop();
  clients.clear();

  EXPECT_EQ(ledger.faults(), std::vector<std::string>()) << cluster_->log();
  EXPECT_GT(ledger.cycle_times().size(), 10U);
  EXPECT_GT(ledger.streamed_again(), 0);
  Planner planner(client::Connection{.address = cluster_->address()});
  for (const auto& [name, cycle_time] : ledger.cycle_times()) {
    EXPECT_EQ(planner.get(name).summary.cycle_time_s, cycle_time);
  }
  for (const auto& [name, digest] : ledger.digests()) EXPECT_EQ(digest_of(planner, name, milliseconds(0)), digest);
}

}  // namespace
}  // namespace kcs::test
