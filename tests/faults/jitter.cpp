// A long run on simulated drives, without a fault: how punctual it was, and whether motion was ever missing. ./run
// jitter
#include <fmt/format.h>
#include <time.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <sstream>
#include <stdexcept>

#include "tests/faults/absences.h"
#include "tests/faults/figures.h"
#include "tests/faults/scene.h"

namespace kcs::faults {
namespace {

constexpr double kPeriod = 0.001;                  // s
constexpr double kPiece = 2000;                    // mm: a minute
constexpr std::chrono::milliseconds kWindow{500};  // twice what the machine has to play

// The line of the gateway's log, from that word on.
std::string jitter_in(const std::string& log) {
  const std::size_t begin = log.find("jitter ");
  if (begin == std::string::npos) return "the gateway's log says nothing of jitter";
  return log.substr(begin, log.find('\n', begin) - begin);
}

std::chrono::system_clock::time_point time_of(const std::string& line) {
  std::tm time{};
  const char* rest = strptime(line.c_str(), "%Y-%m-%dT%H:%M:%S", &time);
  if (rest == nullptr) throw std::runtime_error("the gateway's log has no time: " + line);
  const int fraction = std::stoi(rest + 1);  // behind the point, ms
  return std::chrono::system_clock::from_time_t(timegm(&time)) + std::chrono::milliseconds(fraction);
}

// What went wrong, and how long the computer was away around that time.
void print_warnings(const std::string& log, const std::vector<Absence>& absences) {
  std::istringstream lines(log);
  for (std::string line; std::getline(lines, line);) {
    if (line.find(" warning ") == std::string::npos && line.find(" error ") == std::string::npos) continue;
    std::chrono::milliseconds away{0}, waited{0};
    for (const Absence& absence : absences) {
      const auto before = time_of(line) - absence.end;
      if (before > -kWindow && before < kWindow) (absence.of_the_computer ? away : waited) += absence.length;
    }
    fmt::print("{}\n  within {} s of that the computer was away for {} ms, and ordinary threads waited for {} ms\n",
               line, kWindow.count() / 1000.0, away.count(), waited.count());
  }
}

// True if no motion was missing and all of it was good.
bool run_for(std::chrono::seconds time) {
  const AbsenceWatch watch;
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
  const std::vector<Absence> absences = watch.absences();
  for (const bool computer : {true, false}) {
    std::size_t count = 0;
    std::chrono::milliseconds longest{0};
    for (const Absence& absence : absences) {
      if (absence.of_the_computer != computer) continue;
      ++count;
      longest = std::max(longest, absence.length);
    }
    fmt::print("{} {} times for 20 ms or longer, {} ms at most\n",
               computer ? "the computer itself was away" : "ordinary threads were kept waiting", count,
               longest.count());
  }
  print_warnings(scene.log(), absences);
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
