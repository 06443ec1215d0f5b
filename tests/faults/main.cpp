// Faults at random instants, while a machine runs: what its drives were commanded is judged afterwards. ./run faults
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <random>
#include <set>
#include <thread>

#include "tests/faults/faults.h"

namespace kcs::faults {
namespace {

constexpr double kPeriod = 0.001;  // s

struct Options {
  int count = 200;
  unsigned seed = std::random_device()();
  double longest_stall = 10;  // s
  double piece = 400;         // mm
  std::string only, program, driver;
};

std::size_t count_stops(const std::vector<Place>& places) {
  std::size_t stops = 0;
  for (std::size_t i = 1; i < places.size(); ++i) stops += places[i - 1].moves && !places[i].moves ? 1 : 0;
  return stops;
}

// True if all went well.
bool try_fault(const Program& program, const std::string& driver, const Fault& fault, const Options& options,
               Chance& chance) {
  Scene scene(driver == "hal" ? hal_drives() : simulated_drives(), ProgramCursor(program, options.piece),
              fault.scrambles);
  for (int happened = 0; happened < options.count;) {
    scene.go_on();
    std::this_thread::sleep_for(chance.time(100, 500));
    if (!scene.is_running()) continue;  // its end came first
    fault.happen(scene, chance);
    ++happened;
  }
  scene.go_on();
  scene.run_to_end();
  scene.finish();
  const Verdict verdict = judge(scene.drives().record(), scene.runs(), machine_limits(), kPeriod);
  fmt::print("{:<8}{:<11}{:<18}{:>6}{:>6}{:>7}{:>12.6f}{:>16.1e}  {}\n", program.name, driver, fault.name,
             options.count, scene.runs().size(), count_stops(verdict.places), verdict.largest_share, verdict.farthest,
             verdict.fault.empty() ? "good" : verdict.fault);
  std::fflush(stdout);
  return verdict.fault.empty();
}

bool is_asked_for(const std::string& wish, const std::string& name) { return wish.empty() || wish == name; }

bool try_all(const Options& options) {
  if (const auto missing = missing_for_hal(); missing && is_asked_for(options.driver, "hal")) {
    fmt::print(stderr, "faults: no HAL: {}; --driver simulated does without\n", *missing);
    return false;
  }
  fmt::print("seed {}\n{:<8}{:<11}{:<18}{:>6}{:>6}{:>7}{:>12}{:>16}\n", options.seed, "program", "driver", "fault",
             "times", "runs", "stops", "of a limit", "off curve, mm");
  Chance chance(options.seed, options.longest_stall);
  bool good = true;
  for (const Program& program : {sharp_program(), dense_program()}) {
    if (!is_asked_for(options.program, program.name)) continue;
    for (const char* driver : {"simulated", "hal"}) {
      if (!is_asked_for(options.driver, driver)) continue;
      for (const Fault& fault : all_faults()) {
        if (!is_asked_for(options.only, fault.name) || (fault.kills_gateway && driver != std::string("hal"))) continue;
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
