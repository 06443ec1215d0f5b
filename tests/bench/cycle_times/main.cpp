// The table of cycle times: kcs beside LinuxCNC's simulator, on the same programs, limits and tolerances.
//
// bench_cycle_times CASES RECORDS: RECORDS is the folder in which record.py left LinuxCNC's motions.
#include <fmt/format.h>

#include <algorithm>
#include <exception>
#include <span>
#include <string>

#include "server/planning/plan_path.h"
#include "tests/bench/cycle_times/case.h"
#include "tests/bench/cycle_times/motion_record.h"
#include "tests/bench/program.h"

namespace kcs::bench {
namespace {

constexpr double kFeed = 100;  // mm/s, instead of every feed and rapid

// The case's path; its arcs are chords of so many millimetres at most.
planning::Toolpath path_of(const Case& one, double tolerance) {
  planning::Toolpath path = toolpath_of(text_of(one.file), {.feed = kFeed, .tolerance = tolerance});
  constexpr double kInch = 25.4;  // mm
  for (planning::Segment& segment : path.segments) {
    if (one.inches) segment.end *= kInch;
    segment.tolerance = std::min(segment.tolerance, tolerance);  // whatever the program says
  }
  return path;
}

void print(const std::string& who, const Measures& measures) {
  fmt::print("  {:<24}{:>9.3f}{:>9.1f} %{:>9.1f}", who, measures.duration, 100 * measures.at_feed,
             1000 * measures.deviation);
}

void compare(const Case& one, const std::string& records) {
  fmt::print("{}: {:g} mm/s², tolerance {:g} mm\n", one.name, one.acceleration, one.tolerance);
  constexpr double kFine = 0.01;  // LinuxCNC takes arcs as arcs: it is measured against finer chords
  const Measures theirs = measure(read_record(fmt::format("{}/{}.txt", records, one.name)), kFeed,
                                  path_of(one, kFine * one.tolerance), one.tolerance);
  print("LinuxCNC, no jerk limit", theirs);
  fmt::print("\n  {:<24}{:>9.3f}\n", "LinuxCNC, 50000 mm/s³", one.s_curve);
  const planning::Toolpath path = path_of(one, one.tolerance);
  for (const auto& [jerk, goal] : one.jerks) {
    const planning::Plan plan = planning::plan(path, machine(one.acceleration, jerk));
    Measures ours = measure(record_of(plan.trajectory), kFeed, path, one.tolerance);
    ours.duration = plan.trajectory.duration();
    print(fmt::format("kcs, {:g} mm/s³", jerk), ours);
    fmt::print("{:>10.3f}{:>10.3f}", ours.duration / theirs.duration, ours.duration / one.s_curve);
    if (goal) fmt::print("{:>10.3f}  {}", *goal, ours.duration <= *goal ? "met" : "missed");
    fmt::print("\n");
  }
}

}  // namespace
}  // namespace kcs::bench

int main(int argc, char** argv) {
  const std::span<char*> arguments(argv, static_cast<std::size_t>(argc));
  if (arguments.size() != 3) {
    fmt::print(stderr, "usage: bench_cycle_times CASES RECORDS\n");
    return 2;
  }
  fmt::print(
      "Every feed and rapid is 100 mm/s. LinuxCNC without a jerk limit is Debian's, played now; with one (its newest\n"
      "S-curve planner, not in Debian) it was measured in November 2026.\n\n"
      "                               time    at feed deviation  time / LinuxCNC's       goal\n"
      "                                  s                   µm  no limit   50,000          s\n");
  int failures = 0;
  for (const kcs::bench::Case& one : kcs::bench::load_cases(arguments[1])) {
    try {
      kcs::bench::compare(one, arguments[2]);
    } catch (const std::exception& failure) {
      fmt::print("  {}\n", failure.what());
      ++failures;
    }
  }
  return failures == 0 ? 0 : 1;
}
