// Does the tool stutter on smooth curves? Plans a program, says where and how deep its speed dips, and draws it.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <exception>

#include "client/cli/gnuplot.h"
#include "client/common/command_line.h"
#include "server/planning/plan_path.h"
#include "tests/bench/program.h"
#include "tests/bench/stutter/dips.h"
#include "tests/bench/stutter/picture.h"

namespace kcs::bench {
namespace {

constexpr double kNoticeable = 0.05;

struct Arguments {
  std::string file, picture = "stutter.svg";
  double feed = 100, tolerance = 0.01, acceleration = 2000, jerk = 1e5;
};

void run(const Arguments& arguments) {
  const planning::Toolpath path =
      toolpath_of(text_of(arguments.file), {.feed = arguments.feed, .tolerance = arguments.tolerance});
  const planning::Plan plan = planning::plan(path, machine(arguments.acceleration, arguments.jerk));
  const auto samples = speed_samples(plan.trajectory, path, arguments.tolerance);
  const auto stretches = smooth_stretches(path, arguments.acceleration, arguments.jerk);
  const auto dips = find_dips(samples, stretches);

  const auto smooth =
      std::count_if(stretches.begin(), stretches.end(), [](const Stretch& one) { return one.smooth(); });
  const auto deep = std::count_if(dips.begin(), dips.end(), [](const Dip& dip) { return dip.depth > kNoticeable; });
  std::string result = fmt::format("{} of {} segments in smooth curves, {} dips deeper than {:g} %", smooth,
                                   stretches.size(), deep, 100 * kNoticeable);
  if (!dips.empty()) {
    const Dip& worst = *std::max_element(dips.begin(), dips.end(),
                                         [](const Dip& one, const Dip& other) { return one.depth < other.depth; });
    result += fmt::format(", deepest {:.2f} % to {:.2f} mm/s at {:.3f} mm, line {}", 100 * worst.depth, worst.at.speed,
                          worst.at.length, path.segments[worst.at.segment].line);
  }
  fmt::print("{}\n", result);
  cli::run_gnuplot(picture_script(fmt::format("{}, {:.3f} s\\n{}", arguments.file, plan.trajectory.duration(), result),
                                  arguments.picture, samples, stretches, dips, kNoticeable));
  fmt::print("drawn in {}\n", arguments.picture);
}

}  // namespace
}  // namespace kcs::bench

int main(int argc, char** argv) {
  kcs::bench::Arguments arguments;
  CLI::App app("Plans a G-code program and looks for dips of the speed on its smooth curves.");
  app.add_option("FILE", arguments.file, "G-code program")->required();
  app.add_option("-o,--output", arguments.picture, "picture of speed against path, SVG")->capture_default_str();
  app.add_option("--feed", arguments.feed, "instead of every feed and rapid, mm/s")->capture_default_str();
  app.add_option("--tolerance", arguments.tolerance, "contour error, mm")->capture_default_str();
  app.add_option("--acceleration", arguments.acceleration, "of every axis, mm/s²")->capture_default_str();
  app.add_option("--jerk", arguments.jerk, "of every axis, mm/s³")->capture_default_str();
  if (const auto message = kcs::client::parse(app, argc, argv)) return kcs::client::print(*message);
  try {
    kcs::bench::run(arguments);
    return 0;
  } catch (const std::exception& failure) {
    fmt::print(stderr, "stutter: {}\n", failure.what());
    return 1;
  }
}
