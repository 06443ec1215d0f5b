// What a server does with a machine: begins a run, sends its batches ahead, and goes on after every stop.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "kcs/v1/machine.pb.h"
#include "tests/unit/gateway/machine/straight_motion.h"

namespace kcs::gateway {

// Knows the machine by its reports alone, as a server does that has just been started.
class StraightServer {
 public:
  static constexpr std::uint64_t kBatch = 20;  // setpoints

  StraightServer(std::string run, double length_mm, double period_s, double window_s, int axes = 2)
      : run_(std::move(run)), length_(length_mm), period_(period_s), window_(window_s), axes_(axes) {}

  // What to send after a report.
  std::vector<v1::AttachMachineResponse> react(const v1::MachineReport& report);

  // The order to hold. Until resume() nothing is sent.
  v1::AttachMachineResponse hold();
  void resume() { holding_ = false; }

  bool finished() const { return finished_; }
  // A new connection: what was sent may have been lost.
  void reconnect() { rewinds_ = true; }
  // As if the server had been started anew.
  void restart() { branch_.reset(); }

 private:
  v1::AttachMachineResponse start() const;
  v1::AttachMachineResponse resume_order() const;

  std::string run_;
  double length_;
  double period_;
  double window_;
  int axes_;
  bool holding_ = false;
  bool finished_ = false;
  bool rewinds_ = false;
  // Of the branch that is sent:
  std::optional<std::uint64_t> branch_;
  std::optional<StraightMotion> motion_;
  std::uint64_t begins_ = 0;   // tick
  std::uint64_t sent_ = 0;     // tick
  std::uint64_t refused_ = 0;  // as last reported
};

}  // namespace kcs::gateway
