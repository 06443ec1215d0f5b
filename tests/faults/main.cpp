// Faults at random instants, while a machine runs: what its drives were commanded is judged afterwards. ./run faults
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <chrono>
#include <cmath>
#include <functional>
#include <random>
#include <thread>

#include "tests/faults/judge.h"
#include "tests/faults/scene.h"

namespace kcs::faults {
namespace {

using std::chrono::milliseconds;

constexpr double kPeriod = 0.001;  // s

class Chance {
 public:
  explicit Chance(unsigned seed) : random_(seed) {}

  milliseconds time(int least, int most) {
    return milliseconds(std::uniform_int_distribution<int>(least, most)(random_));
  }
  // As often short as long.
  milliseconds stall() {
    return milliseconds(static_cast<int>(std::pow(10, std::uniform_real_distribution<double>(0, longest_)(random_))));
  }
  void set_longest_stall(double seconds) { longest_ = 3 + std::log10(seconds); }
  double percent() { return std::uniform_int_distribution<int>(0, 4)(random_) == 0 ? 0 : uniform(1, 200); }
  double uniform(double low, double high) { return std::uniform_real_distribution(low, high)(random_); }

 private:
  std::mt19937 random_;
  double longest_ = 4;
};

void wait(milliseconds time) { std::this_thread::sleep_for(time); }

struct Fault {
  const char* name;
  std::function<void(Scene&, Chance&)> happen;  // once, and over again
};

std::vector<Fault> all_faults() {
  return {{"hold",
           [](Scene& scene, Chance&) {
             scene.hold();
             scene.wait_for(v1::RUN_STATE_HELD);
           }},
          {"feed override",
           [](Scene& scene, Chance& chance) {
             scene.set_override(chance.percent());
             wait(chance.time(10, 600));
             scene.set_override(100);
           }},
          {"link pulled",
           [](Scene& scene, Chance& chance) {
             scene.cable().cut(true);
             wait(chance.time(0, 600));
             scene.cable().cut(false);
           }},
          {"link stalled",
           [](Scene& scene, Chance& chance) {
             scene.cable().stall(true);
             wait(chance.stall());
             scene.cable().stall(false);
           }},
          {"link slow",
           [](Scene& scene, Chance& chance) {
             scene.cable().delay(chance.time(1, 80));
             wait(chance.time(100, 800));
             scene.cable().delay(milliseconds(0));
           }},
          {"byte corrupted", [](Scene& scene, Chance&) { scene.cable().corrupt(); }},
          {"server slow",
           [](Scene& scene, Chance& chance) {
             scene.pause_server(true);
             wait(chance.time(1, 700));
             scene.pause_server(false);
           }},
          {"server kill -9", [](Scene& scene, Chance& chance) { scene.restart_server(chance.time(0, 500)); }}};
}

// True if all went well.
bool try_fault(const Part& part, const Fault& fault, int count, Chance& chance) {
  Scene scene(part);
  int happened = 0;
  for (; happened < count; ++happened) {
    scene.go_on();
    if (scene.is_over()) break;
    wait(chance.time(100, 500));
    fault.happen(scene, chance);
  }
  scene.go_on();
  // What is left goes by quickly, and without a fault.
  scene.abort();
  wait(milliseconds(300));
  const Verdict verdict = judge(read_recording(scene.finish()), part.plan, part.limits, kPeriod, false);
  fmt::print("{:<16}{:<16}{:>8}{:>8}{:>14.6f}{:>16.1e}{:>12.1f}  {}\n", part.name, fault.name, happened, verdict.stops,
             verdict.largest_share, verdict.farthest, verdict.reached, verdict.fault.empty() ? "good" : verdict.fault);
  std::fflush(stdout);
  return verdict.fault.empty() && happened > 0;
}

}  // namespace
}  // namespace kcs::faults

int main(int argc, char** argv) {
  using namespace kcs::faults;
  int count = 200;
  unsigned seed = std::random_device()();
  double longest_stall = 10;
  std::string only;
  CLI::App app("Disturbs a running machine at random instants, and judges what its drives were commanded.",
               "kcs_faults");
  app.add_option("COUNT", count, "instants per fault and program")->check(CLI::Range(1, 100000));
  app.add_option("--seed", seed, "of the instants");
  app.add_option("--longest-stall", longest_stall, "of the link, s")->check(CLI::Range(0.01, 100.0));
  app.add_option("--only", only, "this fault alone");
  CLI11_PARSE(app, argc, argv);
  try {
    fmt::print("seed {}\n{:<16}{:<16}{:>8}{:>8}{:>14}{:>16}{:>12}\n", seed, "program", "fault", "times", "stops",
               "of a limit", "off curve, mm", "reached, s");
    Chance chance(seed);
    chance.set_longest_stall(longest_stall);
    bool good = true;
    for (const Part& part : {sharp_part(), dense_part()}) {
      for (const Fault& fault : all_faults()) {
        if (only.empty() || only == fault.name) good = try_fault(part, fault, count, chance) && good;
      }
    }
    return good ? 0 : 1;
  } catch (const std::exception& failure) {
    fmt::print(stderr, "faults: {}\n", failure.what());
    return 1;
  }
}
