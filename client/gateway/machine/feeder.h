// What the server says goes to the player, and what the player says goes to the server.
#pragma once

#include <spdlog/logger.h>

#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>

#include "client/gateway/machine/staging.h"
#include "client/gateway/player/player.h"
#include "kcs/v1/machine.pb.h"

namespace kcs::gateway {

struct FeederOptions {
  std::string machine;     // "machines/NAME"
  double commit_s = 0.04;  // motion to be with the player, > 0; what lies there cannot be replaced any more
  // Ticks that the driver began more than a period late, so far.
  std::function<std::uint64_t()> late_ticks = [] { return std::uint64_t{0}; };
};

// Keeps the run that the machine is in and feeds the player its batches. It lives through every connection: what is
// staged is played while there is none, and the next server that the gateway attaches to learns from report() how far
// the machine has come. Beginning with memory in which a run is not over (a gateway that died was here before), it
// stops the run if it moves, and goes on with it from its rest.
//
// Safe for use by many threads; nobody waits longer than it takes to copy a batch. Only this object feeds `player`.
class Feeder {
 public:
  // player: prepared; must outlive this object, as must whoever plays from it.
  Feeder(kcs_player_memory& player, FeederOptions options, std::shared_ptr<spdlog::logger> log);

  // An order of the server. A command to stop reaches the player before this returns.
  void take(const v1::AttachMachineResponse& order);

  // Looks at the player and hands it what is due. To be called every few milliseconds, server or no server.
  void step();

  // As of the last step.
  v1::MachineReport report() const;
  // Rises with everything that the server should hear of at once.
  std::uint64_t revision() const;
  // A run is on, moving or held.
  bool has_run() const;

  // Brings the machine to rest and begins nothing any more.
  void shut_down();
  // As of the last step: no setpoint is due.
  bool at_rest() const;

 private:
  // What may become of the run.
  enum class Phase {
    kOpen,      // takes batches
    kHolding,   // told to hold: takes none before it is resumed
    kAborting,  // over as soon as the machine rests
    kDead       // cannot go on; stays to be reported until the server ends it
  };

  struct Run {
    std::string name;
    std::string plan;
    Phase phase = Phase::kOpen;
  };

  void adopt();
  void start(const v1::Run& run);
  std::optional<std::string> find_obstacle(const v1::Run& run) const;
  void take(const v1::MotionBatch& batch);
  void take(v1::MachineCommand command);
  void resume(const v1::ResumeOrder& order);
  void stop();
  bool stop_is_under_way() const;
  void follow();
  void follow_run(bool left);
  bool is_finished() const;
  v1::MachineState state() const;
  void note_state();
  void fail(const std::string& why);

  kcs_player_memory& player_;
  FeederOptions options_;
  std::shared_ptr<spdlog::logger> log_;

  mutable std::mutex mutex_;  // guards all below
  kcs_player_report player_report_{};
  std::uint64_t stops_asked_ = 0;
  Staging staging_;
  std::optional<Run> run_;
  std::string fault_;
  std::uint64_t refused_batches_ = 0;  // by this object
  bool refusing_ = false;              // the last batch was refused
  bool shut_down_ = false;
  std::uint64_t revision_ = 0;
  v1::MachineState reported_state_ = v1::MACHINE_STATE_UNSPECIFIED;
};

}  // namespace kcs::gateway
