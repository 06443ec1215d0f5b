// One run of a plan on the machine.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>

#include "client/gateway/clock_figures.h"
#include "client/gateway/measurement.h"
#include "client/gateway/plan_source.h"
#include "client/gateway/player.h"

namespace kcs::gateway {

// In simulated time nothing but this ends a run whose server has stopped to answer.
inline constexpr double kPatienceS = 30;

struct PlaybackOptions {
  double period_s = 0.001;                               // of the drives: one setpoint each, 1e-5 to 10
  double buffer_s = 1;                                   // motion to hold ready against trouble on the network, > 0
  std::optional<double> seconds;                         // play only that much of the plan; none: all of it
  bool simulated_time = false;                           // as fast as it computes, instead of by the clock
  double patience_s = kPatienceS;                        // gives up when no setpoint has come for so long, > 0
  std::optional<std::filesystem::path> record;           // where to write the run as comma-separated values
  std::function<void(std::uint64_t ticks)> on_progress;  // called now and then, by another thread
};

struct PlaybackResult {
  PlayState state = PlayState::kReady;  // at the end: kFinished or kStarved
  RunFigures figures;
  std::optional<ClockFigures> clock;  // none in simulated time
  double buffer_capacity_s = 0;
  std::uint64_t resumptions = 0;       // of a stream that broke
  std::uint64_t unmeasured_ticks = 0;  // that came faster than they could be measured
  std::string feed_failure;            // why no more setpoints came; empty if they all came
};

// Plays `plan`, which `source` has obtained, into the simulated table from rest at the plan's start: fills the buffer,
// then hands out one setpoint each period until the plan ends or a tick finds none. The thread that calls it plays, in
// real time if the system allows; two others fetch setpoints and measure.
// Throws std::system_error if the recording cannot be written.
PlaybackResult play(PlanSource source, const client::Plan& plan, const PlaybackOptions& options);

}  // namespace kcs::gateway
