// The machine that exists only in the computer: drives, and the real-time thread that plays into them.
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <thread>

#include "client/gateway/clock_figures.h"
#include "client/gateway/machine/switches.h"
#include "client/gateway/player/player.h"
#include "client/gateway/simulated_table.h"
#include "client/gateway/trace.h"
#include "client/gateway/vector.h"

namespace kcs::gateway {

// Plays from `memory` into simulated drives, one tick each period of the memory's profile: in real time if the system
// allows it, by absolute deadlines, on a thread of its own.
class SimulatedMachine {
 public:
  // Begins at once, with the drives on unless switched off, at rest at start_mm; the clock of the
  // drives runs faster than the computer's by clock_drift_ppm. memory: prepared. What happens at each
  // tick goes to `trace`. All of them must outlive this object. Throws std::invalid_argument if the profile in `memory`
  // is not sound.
  SimulatedMachine(kcs_player_memory& memory, const Vector& start_mm, double clock_drift_ppm, const Switches& switches,
                   Trace& trace);
  ~SimulatedMachine() { finish(); }

  // Ticks that began more than a period late, so far.
  std::uint64_t late_ticks() const { return late_ticks_; }
  // Ticks that the trace had no room for, so far.
  std::uint64_t untraced_ticks() const { return untraced_ticks_; }

  // Stops ticking, moving or not. Says how punctual the ticks were.
  ClockFigures finish();

 private:
  void run(const std::stop_token& stop);
  void tick();
  Vector move_drives(const Vector& commanded_mm);

  kcs_player_memory& memory_;
  const Switches& switches_;
  Trace& trace_;
  kcs_player player_{};
  kcs_player_input input_{};
  kcs_player_output output_{};
  // Its encoders count from where it stands at the start: so a plan can start at just that place.
  Vector origin_mm_;
  double drives_clock_;  // seconds of the drives in one of the computer's
  SimulatedTable table_;
  ClockFigures figures_;  // of the thread until it has ended
  std::atomic<std::uint64_t> late_ticks_ = 0;
  std::atomic<std::uint64_t> untraced_ticks_ = 0;
  std::jthread thread_;  // last: it uses all the others
};

}  // namespace kcs::gateway
