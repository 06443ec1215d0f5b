// What one, two and three kcsd behind a balancer do in a second, and what of the processors it takes them.
#include <fmt/format.h>

#include <atomic>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <functional>
#include <random>
#include <string>
#include <thread>
#include <vector>

#include "client/sdk/planner.h"
#include "tests/cluster/cluster.h"

namespace kcs::bench {
namespace {

using client::Planner;

constexpr int kClients = 8;
constexpr std::chrono::seconds kTime{6};
constexpr int kSegments = 1000;
constexpr double kStreamPeriod = 1e-4;  // s

// A zigzag with corners of all angles, another one for each seed.
client::PointPath path(std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> step(-5, 5);
  client::PointPath path;
  double x = 0, y = 0;
  for (int i = 0; i <= kSegments; ++i) {
    path.points_mm.insert(path.points_mm.end(), {x, y});
    x += step(random);
    y += step(random);
  }
  return path;
}

client::PlanOptions options() {
  client::PlanOptions options;
  options.machine.axes = 2;
  options.machine.velocity_mm_s = {500, 500};
  options.machine.acceleration_mm_s2 = {2500, 2500};
  options.machine.jerk_mm_s3 = {2e5, 2e5};
  options.feed_mm_s = 100;
  options.tolerance_mm = 0.02;
  return options;
}

struct Rate {
  double per_second;       // of what was done
  double processor_share;  // that the servers took, of one processor
};

// What the clients get done, each as fast as it can: `work` says how much it did.
Rate measure(const test::Cluster& cluster,
             const std::function<std::uint64_t(Planner& planner, std::uint64_t round)>& work) {
  std::atomic<std::uint64_t> done = 0, rounds = 0;
  const auto begin = std::chrono::steady_clock::now();
  const double before = cluster.cpu_seconds();
  {
    std::vector<std::jthread> clients;
    for (int i = 0; i < kClients; ++i) {
      clients.emplace_back([&](const std::stop_token& stop) {
        Planner planner({.address = cluster.address(), .patience = std::chrono::minutes(1)});
        while (!stop.stop_requested()) done += work(planner, ++rounds);
      });
    }
    std::this_thread::sleep_for(kTime);
  }
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - begin;
  return {.per_second = static_cast<double>(done) / took.count(),
          .processor_share = (cluster.cpu_seconds() - before) / took.count()};
}

void measure_replicas(std::size_t count) {
  test::Cluster cluster(count);
  for (std::size_t place = 0; place < count; ++place) cluster.start(place);
  const Rate plans = measure(cluster, [&](Planner& planner, std::uint64_t round) -> std::uint64_t {
    planner.plan_points(path(round), options());
    return 1;
  });
  const std::string plan = Planner(cluster.address()).plan_points(path(1), options()).name;
  const Rate setpoints = measure(cluster, [&](Planner& planner, std::uint64_t) {
    client::SetpointStream stream = planner.stream_setpoints(plan, {.period_s = kStreamPeriod});
    std::uint64_t read = 0;
    for (client::SetpointBatch batch; stream.next(batch);) read += batch.size();
    return read;
  });
  fmt::print("{:>8}{:>12.0f}{:>12.0f}{:>18.1f}{:>16.1f}{:>18.0f}\n", count, plans.per_second,
             plans.per_second * kSegments, 1000 * plans.processor_share / plans.per_second, setpoints.per_second / 1e6,
             1e9 * setpoints.processor_share / setpoints.per_second);
  std::fflush(stdout);
}

}  // namespace
}  // namespace kcs::bench

int main() {
  try {
    fmt::print("{} clients, plans of {} segments, {} processors for all of it\n", kcs::bench::kClients,
               kcs::bench::kSegments, std::thread::hardware_concurrency());
    fmt::print("{:>8}{:>12}{:>12}{:>18}{:>16}{:>18}\n", "servers", "plans/s", "segments/s", "kcsd ms/plan",
               "M setpoints/s", "kcsd ns/setpoint");
    for (const std::size_t count : {1, 2, 3}) kcs::bench::measure_replicas(count);
    return 0;
  } catch (const std::exception& failure) {
    fmt::print(stderr, "bench_replicas: {}\n", failure.what());
    return 1;
  }
}
