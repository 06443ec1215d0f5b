#include <vector>

#include "client/sdk/planner.h"
#include "server/motion/sampler.h"
#include "server/planning/plan_path.h"
#include "server/service/server.h"
#include "tests/bench/program.h"
#include "tests/bench/speed/benchmarks.h"
#include "tests/bench/speed/paths.h"
#include "tests/bench/speed/tcp_connection.h"

namespace kcs::bench {
namespace {

constexpr std::size_t kSegments = 20'000;
constexpr double kPeriod = 0.0001;             // s
constexpr double kBytes = 3 * sizeof(double);  // of a setpoint
constexpr std::size_t kCopied = std::size_t{1} << 24;

void count(benchmark::State& state, double setpoints) {
  state.counters["setpoints/s"] = rate(setpoints);
  state.counters["B/s"] = rate(setpoints * kBytes);
}

void sample(benchmark::State& state) {
  const planning::Plan plan = planning::plan(relief(kSegments), machine(kAcceleration, kJerk));
  std::vector<planning::Vector> positions;
  while (state.KeepRunning()) {
    motion::Sampler sampler(plan.trajectory, kPeriod);
    positions.resize(sampler.count());
    for (std::uint64_t i = 0; i < sampler.count(); ++i) positions[i] = sampler.at(i).state.position;
    benchmark::ClobberMemory();
  }
  count(state, static_cast<double>(positions.size()));
}

client::PointPath points_of(const planning::Toolpath& path) {
  client::PointPath points{.feed_mm_s = {kFeed}, .tolerance_mm = {kTolerance}};
  const auto add = [&](const planning::Vector& point) {
    points.points_mm.insert(points.points_mm.end(), {point.x(), point.y(), point.z()});
  };
  add(path.start);
  for (const planning::Segment& segment : path.segments) add(segment.end);
  return points;
}

void stream(benchmark::State& state) {
  service::Server server({.listen = "127.0.0.1:0", .store = {.database = "memory"}});
  client::Planner planner(server.address());
  const client::Machine machine{.axes = 3,
                                .velocity_mm_s = {500, 500, 500},
                                .acceleration_mm_s2 = {kAcceleration, kAcceleration, kAcceleration},
                                .jerk_mm_s3 = {kJerk, kJerk, kJerk}};
  const client::Plan plan = planner.plan_points(points_of(relief(kSegments)), {.machine = machine});
  std::size_t setpoints = 0;
  while (state.KeepRunning()) {
    auto stream = planner.stream_setpoints(plan.name, {.period_s = kPeriod, .batch_size = 16384});
    setpoints = 0;
    for (client::SetpointBatch batch; stream.next(batch);) setpoints += batch.size();
  }
  count(state, static_cast<double>(setpoints));
}

void send_raw(benchmark::State& state) {
  TcpConnection connection;
  while (state.KeepRunning()) connection.transfer(kCopied);
  state.counters["B/s"] = rate(kCopied);
}

}  // namespace

void add_sampling(Table& table) {
  benchmark::RegisterBenchmark("sample", sample)->Unit(benchmark::kMillisecond);
  add_memory_copy("copy/setpoints", kCopied);
  table.add({"sampling", "setpoints/s", "sample"});
  table.add({"sampling", "B/s", "sample", "a memory copy", "copy/setpoints"});
}

void add_streaming(Table& table) {
  benchmark::RegisterBenchmark("stream", stream)->Unit(benchmark::kMillisecond)->UseRealTime();
  benchmark::RegisterBenchmark("raw TCP", send_raw)->Unit(benchmark::kMillisecond)->UseRealTime();
  table.add({"streaming over loopback", "setpoints/s", "stream"});
  table.add({"streaming over loopback", "B/s", "stream", "raw TCP", "raw TCP"});
}

}  // namespace kcs::bench
