// What planning live costs: speed and memory over long paths, and how soon the first setpoint comes. A kcsd of its own,
// over loopback.
#include <fmt/format.h>

#include <cstdio>
#include <exception>

#include "tests/bench/live/live_benchmarks.h"
#include "tests/bench/speed/paths.h"

namespace kcs::bench {
namespace {

constexpr double kMegabyte = 1 << 20;

void print_throughput() {
  fmt::print("{:>12}{:>10}{:>14}{:>14}{:>18}{:>18}\n", "segments", "s", "segments/s", "setpoints", "most memory, MB",
             "at the end, MB");
  for (const std::size_t segments : {50'000, 500'000, 5'000'000}) {
    const ServerProcess server;
    const Throughput found = measure_throughput(server, segments);
    fmt::print("{:>12}{:>10.1f}{:>14.0f}{:>14}{:>18.1f}{:>18.1f}\n", segments, found.seconds,
               static_cast<double>(segments) / found.seconds, found.setpoints,
               static_cast<double>(found.most_memory) / kMegabyte, static_cast<double>(found.end_memory) / kMegabyte);
    std::fflush(stdout);
  }
}

void print_latency() {
  constexpr std::size_t kEnough = 50'000;
  const ServerProcess server;
  fmt::print(
      "\nFrom the last segment of the look-ahead to the first setpoint (aim: 5 ms)\n{:>12}{:>12}{:>14}{:>14}{:>27}\n",
      "path", "segments", "median, ms", "largest, ms", "planning of it alone, ms");
  for (const PathKind& kind : kPathKinds) {
    const Latency found = measure_latency(server, kind.make(kEnough));
    fmt::print("{:>12}{:>12}{:>14.2f}{:>14.2f}{:>27.2f}\n", kind.name, found.segments, 1000 * found.median,
               1000 * found.largest, 1000 * found.planning);
    std::fflush(stdout);
  }
}

}  // namespace
}  // namespace kcs::bench

int main() {
  try {
    kcs::bench::print_latency();
    kcs::bench::print_throughput();
    return 0;
  } catch (const std::exception& failure) {
    fmt::print(stderr, "bench: {}\n", failure.what());
    return 1;
  }
}
