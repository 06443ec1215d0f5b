#include <fmt/format.h>

#include <algorithm>

#include "server/planning/plan_path.h"
#include "tests/bench/program.h"
#include "tests/bench/speed/benchmarks.h"
#include "tests/bench/speed/paths.h"

namespace kcs::bench {
namespace {

const gcode::Options kOptions{.feed = kFeed, .tolerance = kTolerance};

void read(benchmark::State& state, const std::string& text) {
  std::size_t segments = 0;
  while (state.KeepRunning()) segments = toolpath_of(text, kOptions).segments.size();
  state.counters["lines/s"] = rate(static_cast<double>(std::count(text.begin(), text.end(), '\n')));
  state.counters["B/s"] = rate(static_cast<double>(text.size()));
  state.counters["segments/s"] = rate(static_cast<double>(segments));
}

void plan(benchmark::State& state, const std::string& text) {
  const planning::Toolpath path = toolpath_of(text, kOptions);
  std::size_t segments = 0;
  while (state.KeepRunning()) segments = planning::plan(path, machine(kAcceleration, kJerk)).summary.segments;
  state.counters["segments/s"] = rate(static_cast<double>(segments));
}

void read_and_plan(benchmark::State& state, const std::string& text) {
  planning::Plan plan;
  while (state.KeepRunning()) plan = planning::plan(toolpath_of(text, kOptions), machine(kAcceleration, kJerk));
  const auto segments = static_cast<double>(plan.summary.segments);
  state.counters["lines/s"] = rate(static_cast<double>(std::count(text.begin(), text.end(), '\n')));
  state.counters["s of motion"] = plan.summary.cycle_time;
  const std::size_t kept = plan.trajectory.bytes() + plan.corners.bytes() + plan.path.bytes() +
                           plan.milestones.capacity() * sizeof(motion::Milestone);
  state.counters["B/segment kept"] = static_cast<double>(kept) / segments;
}

std::string gcode_of(const planning::Toolpath& path) {
  std::string text = fmt::format("G21 G90 F{}\n", kFeed * 60);
  for (const planning::Segment& segment : path.segments) {
    text += fmt::format("G1 X{:.4f} Y{:.4f} Z{:.4f}\n", segment.end.x(), segment.end.y(), segment.end.z());
  }
  return text;
}

void add_text(Table& table, const std::string& name, const std::string& text) {
  const std::string reading = "read/" + name, planning = "plan/" + name, both = "read and plan/" + name,
                    copying = "copy/" + name;
  benchmark::RegisterBenchmark(reading.c_str(), read, text)->Unit(benchmark::kMillisecond);
  benchmark::RegisterBenchmark(planning.c_str(), plan, text)->Unit(benchmark::kMillisecond);
  benchmark::RegisterBenchmark(both.c_str(), read_and_plan, text)->Unit(benchmark::kMillisecond);
  add_memory_copy(copying, text.size());
  table.add({"reading " + name, "B/s", reading, "a memory copy", copying});
  table.add({"reading " + name, "lines/s", reading});
  table.add({"planning " + name, "segments/s", planning, "", "", "200 k"});
  table.add({"reading and planning " + name, "lines/s", both, "", "", "100 k"});
  table.add({"plan of " + name, "B/segment kept", both, "", "", "200"});
}

}  // namespace

void add_reading(Table& table) {
  constexpr std::size_t kLines = 20'000;
  add_text(table, "G-code of the relief", gcode_of(relief(kLines)));
}

void add_programs(Table& table, std::span<char*> files) {
  for (const std::string file : files) add_text(table, file.substr(file.rfind('/') + 1), text_of(file));
}

}  // namespace kcs::bench
