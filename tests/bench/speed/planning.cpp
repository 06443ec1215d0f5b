#include <fmt/format.h>

#include <array>
#include <string>
#include <utility>
#include <vector>

#include "server/motion/verifier.h"
#include "server/planning/plan_path.h"
#include "tests/bench/program.h"
#include "tests/bench/speed/benchmarks.h"
#include "tests/bench/speed/memory.h"
#include "tests/bench/speed/paths.h"

namespace kcs::bench {
namespace {

using planning::CornerStrategy;

constexpr std::size_t kSegments = 20'000;

void plan(benchmark::State& state, const PathKind& kind, CornerStrategy strategy) {
  const planning::Toolpath path = kind.make(kSegments);
  planning::PlanOptions options = machine(kAcceleration, kJerk);
  options.strategy = strategy;
  double cycle_time = 0;
  while (state.KeepRunning()) cycle_time = planning::plan(path, options).summary.cycle_time;
  state.counters["segments/s"] = rate(kSegments);
  state.counters["s of motion"] = cycle_time;
}

void verify(benchmark::State& state, const PathKind& kind) {
  const planning::Toolpath path = kind.make(kSegments);
  const planning::PlanOptions options = machine(kAcceleration, kJerk);
  const planning::Plan plan = planning::plan(path, options);
  std::vector<planning::Vector> points = {path.start};
  for (const planning::Segment& segment : path.segments) points.push_back(segment.end);
  constexpr double kAnyReach = 1e3;  // mm
  const std::vector<double> feeds(kSegments, kFeed), tolerances(kSegments, kTolerance), reaches(kSegments, kAnyReach),
      rests(kSegments, -1);
  while (state.KeepRunning()) {
    const auto found = motion::verify(plan.trajectory, {points, feeds, tolerances, reaches, rests}, options.limits);
    if (!found.passed()) state.SkipWithError(found.fault.c_str());
  }
  state.counters["segments/s"] = rate(kSegments);
}

void scale(benchmark::State& state, std::size_t segments) {
  const planning::Toolpath path = relief(segments);
  const auto count = static_cast<double>(segments);
  while (state.KeepRunning()) {
    const std::size_t before = allocated();
    const PeakMemory memory;
    const planning::Plan plan = planning::plan(path, machine(kAcceleration, kJerk));
    state.counters["B/segment at the peak"] = static_cast<double>(memory.most()) / count;
    state.counters["B/segment kept"] = static_cast<double>(allocated() - before) / count;
  }
  state.counters["segments/s"] = rate(count);
}

}  // namespace

void add_planning(Table& table) {
  constexpr std::array kPaper = {std::pair{"INTERRUPTED", CornerStrategy::kInterrupted},
                                 std::pair{"UNINTERRUPTED", CornerStrategy::kUninterrupted}};
  for (const PathKind& kind : kPathKinds) {
    const auto name = [&](const std::string& what) { return fmt::format("{}/{}", kind.name, what); };
    const std::string ours = name("plan"), check = name("verify");
    benchmark::RegisterBenchmark(ours.c_str(), plan, kind, CornerStrategy::kAuto)->Unit(benchmark::kMillisecond);
    benchmark::RegisterBenchmark(check.c_str(), verify, kind)->Unit(benchmark::kMillisecond);
    for (const auto& [strategy, value] : kPaper) {
      benchmark::RegisterBenchmark(name(strategy).c_str(), plan, kind, value)->Unit(benchmark::kMillisecond);
    }
    const std::string planning = fmt::format("planning, {}", kind.name),
                      time = fmt::format("cycle time, {}", kind.name);
    table.add({planning, "segments/s", ours, "verification alone", check, "200 k"});
    for (const auto& [strategy, value] : kPaper) table.add({planning, "segments/s", ours, strategy, name(strategy)});
    for (const auto& [strategy, value] : kPaper) table.add({time, "s of motion", ours, strategy, name(strategy)});
  }
}

void add_scaling(Table& table) {
  constexpr std::size_t kFew = 20'000;
  const auto name = [](std::size_t segments) { return fmt::format("relief/{} segments", segments); };
  for (const std::size_t segments : {kFew, 10 * kFew, 100 * kFew}) {
    const std::string each = name(segments);
    benchmark::RegisterBenchmark(each.c_str(), scale, segments)->Unit(benchmark::kMillisecond)->Iterations(1);
    const std::string few = segments > kFew ? name(kFew) : "";
    table.add({each, "segments/s", each, few, few, few.empty() ? "" : "1: linear"});
    table.add({each, "B/segment kept", each, few, few, "200"});
    table.add({each, "B/segment at the peak", each, few, few});
  }
}

}  // namespace kcs::bench
