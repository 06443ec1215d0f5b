// What one, two and three kcsd behind a balancer do in a second, and what of the processors it takes them.
#include <fmt/format.h>

#include <atomic>
#include <chrono>
#include <cmath>
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
#include "tests/cluster/jobs.h"

namespace kcs::bench {
namespace {

using client::Planner;

constexpr int kClients = 8;
constexpr std::chrono::seconds kTime{6};
constexpr int kSegments = 1000;
constexpr double kStreamPeriod = 1e-4;  // s

// Another one for each seed: a curve in chords of 0.2 mm, as CAM programs have them.
client::PointPath curve(std::uint64_t seed) {
  std::mt19937_64 random(seed);
  const double stretch = std::uniform_real_distribution(0.5, 2.0)(random);
  client::PointPath path;
  for (int i = 0; i <= kSegments; ++i) {
    const double angle = 0.01 * i;
    path.points_mm.insert(path.points_mm.end(), {20 * std::cos(angle), 20 * stretch * std::sin(1.5 * angle)});
  }
  return path;
}

// So near to each other that they overlap, the most that there is to plan.
client::PointPath near_corners(std::uint64_t seed) { return test::corners(seed, kSegments, 5); }

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
  const auto plans_of = [&](client::PointPath path_of(std::uint64_t)) {
    return measure(cluster, [&](Planner& planner, std::uint64_t round) -> std::uint64_t {
      planner.plan_points(path_of(round), test::job_options());
      return 1;
    });
  };
  const Rate curves = plans_of(curve), zigzags = plans_of(near_corners);
  const std::string plan = Planner(cluster.address()).plan_points(curve(1), test::job_options()).name;
  const Rate setpoints = measure(cluster, [&](Planner& planner, std::uint64_t) {
    client::SetpointStream stream = planner.stream_setpoints(plan, {.period_s = kStreamPeriod});
    std::uint64_t read = 0;
    for (client::SetpointBatch batch; stream.next(batch);) read += batch.size();
    return read;
  });
  fmt::print("{:>8}{:>12.1f}{:>16.1f}{:>12.1f}{:>16.1f}{:>16.1f}{:>18.0f}\n", count, curves.per_second,
             1000 * curves.processor_share / curves.per_second, zigzags.per_second,
             1000 * zigzags.processor_share / zigzags.per_second, setpoints.per_second / 1e6,
             1e9 * setpoints.processor_share / setpoints.per_second);
  std::fflush(stdout);
}

}  // namespace
}  // namespace kcs::bench

int main() {
  try {
    fmt::print("{} clients, plans of {} segments, {} processors for all of it\n", kcs::bench::kClients,
               kcs::bench::kSegments, std::thread::hardware_concurrency());
    fmt::print("{:>8}{:>12}{:>16}{:>12}{:>16}{:>16}{:>18}\n", "servers", "curves/s", "kcsd ms each", "corners/s",
               "kcsd ms each", "M setpoints/s", "kcsd ns each");
    for (const std::size_t count : {1, 2, 3}) kcs::bench::measure_replicas(count);
    return 0;
  } catch (const std::exception& failure) {
    fmt::print(stderr, "bench_replicas: {}\n", failure.what());
    return 1;
  }
}
