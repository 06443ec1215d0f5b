// A long run on simulated drives, without a fault: how punctual it was, and whether motion was ever missing. ./run
// jitter
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <chrono>

#include "tests/faults/figures.h"
#include "tests/faults/scene.h"

namespace kcs::faults {
namespace {

constexpr double kPeriod = 0.001;  // s
constexpr double kPiece = 2000;    // mm: a minute

// The line of the gateway's log, from that word on.
std::string jitter_in(const std::string& log) {
  const std::size_t begin = log.find("jitter ");
  if (begin == std::string::npos) return "the gateway's log says nothing of jitter";
  return log.substr(begin, log.find('\n', begin) - begin);
}

// True if no motion was missing and all of it was good.
bool run_for(std::chrono::seconds time) {
  const Program program = dense_program();
  Scene scene(simulated_drives(), ProgramCursor(program, kPiece));
  const double begin = scene.drives().now();
  for (const auto end = std::chrono::steady_clock::now() + time; std::chrono::steady_clock::now() < end;) {
    scene.go_on();
    scene.run_to_end();
  }
  const std::uint64_t underruns = scene.starvations();
  const double server_share = scene.service().cpu_seconds() / (scene.drives().now() - begin);
  scene.finish();
  const Commands commands = scene.drives().record();
  const Verdict verdict = judge(commands, scene.runs(), machine_limits(), kPeriod);
  const Figures figures = measure(commands, verdict, {}, machine_limits(), kPeriod);
  fmt::print("{} commands, {} runs, {} underruns, {} stops\n", commands.size(), scene.runs().size(), underruns,
             figures.stops);
  fmt::print("largest share of a limit {:.6f}, farthest from the planned curve {:.1e} mm: {}\n", verdict.largest_share,
             verdict.farthest, verdict.fault.empty() ? "good" : verdict.fault);
  fmt::print("the server took {:.1f} % of a processor\n", 100 * server_share);
  fmt::print("{}\n", jitter_in(scene.log()));
  return verdict.fault.empty() && underruns == 0 && figures.stops == scene.runs().size();
}

}  // namespace
}  // namespace kcs::faults

int main(int argc, char** argv) {
  int seconds = 3600;
  CLI::App app("Runs the demo's part again and again on simulated drives, and judges what they were commanded.",
               "kcs_jitter");
  app.add_option("SECONDS", seconds, "how long (default: 3600); the last run goes to its end")
      ->check(CLI::Range(1, 1000000));
  CLI11_PARSE(app, argc, argv);
  try {
    return kcs::faults::run_for(std::chrono::seconds(seconds)) ? 0 : 1;
  } catch (const std::exception& failure) {
    fmt::print(stderr, "jitter: {}\n", failure.what());
    return 1;
  }
}
