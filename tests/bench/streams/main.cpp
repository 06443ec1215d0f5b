// A thousand machines that take their setpoints at the pace of the machine: how punctually they get them. A kcsd of its
// own, over loopback.
#include <fmt/format.h>
#include <grpcpp/create_channel.h>

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <deque>
#include <exception>
#include <memory>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "client/sdk/planner.h"
#include "tests/bench/live/server_process.h"
#include "tests/bench/streams/paced_stream.h"

namespace kcs::bench {
namespace {

constexpr int kStreams = 1000, kConnections = 20;
constexpr double kPeriod = 0.001;             // s
constexpr std::uint64_t kSetpoints = 20'000;  // of each stream
// From one call to the next: delays count from the call on, and to take a thousand calls takes a server 0.1 s.
constexpr std::chrono::milliseconds kGap{2};
constexpr double kMegabyte = 1 << 20;

// A plan of more than kSetpoints.
std::string make_plan(const ServerProcess& server) {
  const client::Machine machine{.axes = 3,
                                .velocity_mm_s = {500, 500, 500},
                                .acceleration_mm_s2 = {5000, 5000, 5000},
                                .jerk_mm_s3 = {1e5, 1e5, 1e5}};
  client::PointPath path{.feed_mm_s = {100}};
  for (int i = 0; i <= 300; ++i) {
    const double x = i, y = 10 * (i % 2), z = i % 3;
    path.points_mm.insert(path.points_mm.end(), {x, y, z});
  }
  client::Planner planner(server.address());
  return planner.plan_points(path, {.machine = machine}).name;
}

std::vector<std::unique_ptr<v1::PlanningService::Stub>> connect(const ServerProcess& server) {
  grpc::ChannelArguments own;
  own.SetInt(GRPC_ARG_USE_LOCAL_SUBCHANNEL_POOL, 1);
  std::vector<std::unique_ptr<v1::PlanningService::Stub>> stubs;
  for (int i = 0; i < kConnections; ++i) {
    const auto channel = grpc::CreateCustomChannel(server.address(), grpc::InsecureChannelCredentials(), own);
    if (!channel->WaitForConnected(std::chrono::system_clock::now() + std::chrono::seconds(10))) {
      throw std::runtime_error("kcsd takes no connection");
    }
    stubs.push_back(v1::PlanningService::NewStub(channel));
  }
  return stubs;
}

double percentile(const std::vector<float>& sorted, double share) {
  return 1000 * static_cast<double>(sorted[static_cast<std::size_t>(share * static_cast<double>(sorted.size() - 1))]);
}

void run(double lead) {
  const ServerProcess server;
  v1::StreamSetpointsRequest request;
  request.set_name(make_plan(server));
  request.set_period_s(kPeriod);
  request.set_last_index(kSetpoints - 1);
  request.set_lead_s(lead);
  const auto stubs = connect(server);
  const auto begin = std::chrono::steady_clock::now();
  const double busy = server.cpu_seconds();
  std::deque<PacedStream> streams;
  for (int i = 0; i < kStreams; ++i) {
    streams.emplace_back(*stubs[static_cast<std::size_t>(i % kConnections)], request);
    std::this_thread::sleep_for(kGap);
  }
  std::vector<float> delays;
  std::uint64_t late_setpoints = 0;
  int late_streams = 0;
  for (PacedStream& stream : streams) {
    if (const std::string fault = stream.finish(); !fault.empty()) throw std::runtime_error(fault);
    delays.insert(delays.end(), stream.delays().begin(), stream.delays().end());
    late_setpoints += stream.late_setpoints();
    late_streams += *std::max_element(stream.delays().begin(), stream.delays().end()) > kLate ? 1 : 0;
  }
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  std::sort(delays.begin(), delays.end());
  fmt::print("{:>8.0f}{:>14.0f}{:>10.2f}{:>10.2f}{:>10.2f}{:>10.2f}{:>16}{:>18}{:>14.2f}{:>14.0f}\n", 1000 * lead,
             static_cast<double>(delays.size()) / seconds, percentile(delays, 0.5), percentile(delays, 0.99),
             percentile(delays, 0.999), percentile(delays, 1), late_streams, late_setpoints,
             (server.cpu_seconds() - busy) / seconds, static_cast<double>(server.most_memory()) / kMegabyte);
  std::fflush(stdout);
}

}  // namespace
}  // namespace kcs::bench

int main() {
  using namespace kcs::bench;
  try {
    fmt::print("{} streams, each a setpoint of three axes every {} ms for {} s; late: by {} ms\n", kStreams,
               1000 * kPeriod, static_cast<double>(kSetpoints) * kPeriod, 1000 * kLate);
    fmt::print("{:>8}{:>14}{:>40}{:>16}{:>18}{:>14}{:>14}\n", "lead", "batches", "after they were due, ms",
               "streams with", "setpoints late by", "server,", "server");
    fmt::print("{:>8}{:>14}{:>10}{:>10}{:>10}{:>10}{:>16}{:>18}{:>14}{:>14}\n", "ms", "per second", "p50", "p99",
               "p99.9", "most", "a late batch", "their own time", "processors", "memory, MB");
    for (const double lead : {0.0, 0.02, 0.1}) run(lead);
    return 0;
  } catch (const std::exception& failure) {
    fmt::print(stderr, "bench: {}\n", failure.what());
    return 1;
  }
}
