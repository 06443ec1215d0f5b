// Faults at random instants, while a machine runs: what its drives were commanded is judged afterwards. ./run faults
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <random>
#include <set>
#include <thread>

#include "tests/faults/faults.h"
#include "tests/faults/figures.h"

namespace kcs::faults {
namespace {

constexpr double kPeriod = 0.001;  // s

struct Options {
  std::size_t count = 200;
  unsigned seed = std::random_device()();
  double longest_stall = 10;  // s
  double piece = 400;         // mm
  std::string only, skip, program, driver;
};

// A tail begins behind a whole tick, so that rounding may cost it one.
constexpr double kRounding = 1.5 * kPeriod;

// Reactions, for their median to say something of the machine, not of what else the computer did.
constexpr std::size_t kEnough = 5;

// p50/largest, ms.
std::string in_ms(const std::vector<double>& sorted) {
  if (sorted.empty()) return "-";
  return fmt::format("{:.0f}/{:.0f}", 1000 * *median(sorted), 1000 * sorted.back());
}

// What is wrong; empty: nothing.
std::string find_fault(const Verdict& verdict, const Figures& figures, const Fault& fault) {
  if (!verdict.fault.empty()) return verdict.fault;
  if (fault.stops_by_tail && figures.longest_beyond_tail > kRounding) {
    return fmt::format("a stop took {:.0f} ms longer than its planned tail", 1000 * figures.longest_beyond_tail);
  }
  const auto reaction = median(figures.reactions);
  if (fault.reaction_s && figures.reactions.size() >= kEnough && *reaction > *fault.reaction_s) {
    return fmt::format("half of the reactions came later than {:.0f} ms", 1000 * *fault.reaction_s);
  }
  return {};
}

// True if all went well.
bool try_fault(const Program& program, const std::string& driver, const Fault& fault, const Options& options,
               Chance& chance) {
  Scene scene(driver == "hal" ? hal_drives() : simulated_drives(), ProgramCursor(program, options.piece),
              fault.scrambles, fault.replicas ? replicas() : one_server());
  std::vector<double> instants;
  while (instants.size() < options.count) {
    scene.go_on();
    std::this_thread::sleep_for(chance.time(100, 500));
    if (!scene.is_running()) continue;  // its end came first
    instants.push_back(scene.drives().now());
    fault.happen(scene, chance);
  }
  scene.go_on();
  scene.run_to_end();
  scene.finish();
  const Commands commands = scene.drives().record();
  const Verdict verdict = judge(commands, scene.runs(), machine_limits(), kPeriod);
  const Figures figures = measure(commands, verdict, instants, machine_limits(), kPeriod);
  const std::string wrong = find_fault(verdict, figures, fault);
  fmt::print("{:<8}{:<11}{:<18}{:>6}{:>6}{:>7}{:>12.6f}{:>16.1e}{:>14}{:>14}  {}\n", program.name, driver, fault.name,
             figures.instants, scene.runs().size(), figures.stops, verdict.largest_share, verdict.farthest,
             in_ms(figures.reactions), in_ms(figures.stop_times), wrong.empty() ? "good" : wrong);
  std::fflush(stdout);
  return wrong.empty();
}

bool is_asked_for(const std::string& wish, const std::string& name) { return wish.empty() || wish == name; }

bool try_all(const Options& options) {
  if (const auto missing = missing_for_hal(); missing && is_asked_for(options.driver, "hal")) {
    fmt::print(stderr, "faults: no HAL: {}; --driver simulated does without\n", *missing);
    return false;
  }
  fmt::print("seed {}\n{:<8}{:<11}{:<18}{:>6}{:>6}{:>7}{:>12}{:>16}{:>14}{:>14}\n", options.seed, "program", "driver",
             "fault", "times", "runs", "stops", "of a limit", "off curve, mm", "reacts, ms", "stops in, ms");
  Chance chance(options.seed, options.longest_stall);
  bool good = true;
  for (const Program& program : {sharp_program(), dense_program()}) {
    if (!is_asked_for(options.program, program.name)) continue;
    for (const char* driver : {"simulated", "hal"}) {
      if (!is_asked_for(options.driver, driver)) continue;
      for (const Fault& fault : all_faults()) {
        const bool wanted = is_asked_for(options.only, fault.name) && fault.name != options.skip;
        if (!wanted || (fault.kills_gateway && driver != std::string("hal"))) continue;
        if (const auto missing = fault.replicas ? missing_for_replicas() : std::nullopt) {
          fmt::print("{:<8}{:<11}{:<18}skipped: {}\n", program.name, driver, fault.name, *missing);
          continue;
        }
        good = try_fault(program, driver, fault, options, chance) && good;
      }
    }
  }
  return good;
}

}  // namespace
}  // namespace kcs::faults

int main(int argc, char** argv) {
  using namespace kcs::faults;
  Options options;
  std::set<std::string> names;
  for (const Fault& fault : all_faults()) names.insert(fault.name);
  CLI::App app("Disturbs a running machine at random instants, and judges what its drives were commanded.",
               "kcs_faults");
  app.add_option("COUNT", options.count, "instants per fault, program and driver")->check(CLI::Range(1, 100000));
  app.add_option("--seed", options.seed, "of the instants");
  app.add_option("--longest-stall", options.longest_stall, "of the link, s")->check(CLI::Range(0.01, 100.0));
  app.add_option("--piece", options.piece, "length of a run, mm")->check(CLI::Range(1.0, 1e6));
  app.add_option("--only", options.only, "this fault alone")->check(CLI::IsMember(names));
  app.add_option("--skip", options.skip, "all but this fault")->check(CLI::IsMember(names));
  app.add_option("--program", options.program, "this one alone")->check(CLI::IsMember({"sharp", "dense"}));
  app.add_option("--driver", options.driver, "this one alone")->check(CLI::IsMember({"simulated", "hal"}));
  CLI11_PARSE(app, argc, argv);
  try {
    return try_all(options) ? 0 : 1;
  } catch (const std::exception& failure) {
    fmt::print(stderr, "faults: {}\n", failure.what());
    return 1;
  }
}
