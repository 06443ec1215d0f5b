// What is measured of PlanLive.
#pragma once

#include <cstddef>

#include "client/sdk/plan.h"
#include "server/planning/toolpath.h"
#include "tests/bench/live/server_process.h"

namespace kcs::bench {

// The machine of the other benchmarks, and their tolerance.
client::PlanOptions live_options();

struct Throughput {
  double seconds = 0;           // from the first point to the plan
  std::size_t setpoints = 0;    // that came
  std::size_t most_memory = 0;  // of the server, bytes
  std::size_t end_memory = 0;   // before it sends the plan, bytes
};

// Sends an endless curve in chords of 0.05 to 0.15 mm up to so many segments, as fast as the server takes them.
Throughput measure_throughput(const ServerProcess& server, std::size_t segments);

struct Latency {
  std::size_t segments = 0;        // that the first setpoint needs
  double median = 0, largest = 0;  // s
  double planning = 0;             // s of it, in this process: to settle what the first setpoint needs
};

// From the sending of the point that is the last of the look-ahead to the arrival of the first setpoint, for the
// segments of a path.
Latency measure_latency(const ServerProcess& server, const planning::Toolpath& path);

}  // namespace kcs::bench
