// A machine on the bench: the player, drives that follow at once, and the feeder, in simulated time.
#pragma once

#include <spdlog/sinks/null_sink.h>

#include <algorithm>
#include <memory>
#include <vector>

#include "client/gateway/machine/feeder.h"
#include "client/gateway/machine/player_memory.h"
#include "tests/unit/gateway/machine/straight_motion.h"

namespace kcs::gateway {

inline std::shared_ptr<spdlog::logger> no_log() {
  return std::make_shared<spdlog::logger>("test", std::make_shared<spdlog::sinks::null_sink_mt>());
}

class Bench {
 public:
  static constexpr int kFeedEvery = 4;  // ticks

  Bench() {
    kcs_player_start(&player_, memory_.get());
    replace_gateway();
    tick(kFeedEvery);
  }

  // The gateway dies, and another one takes its place; the player goes on.
  void replace_gateway() {
    feeder_ = std::make_unique<Feeder>(*memory_, FeederOptions{.machine = "machines/bench"}, no_log());
  }

  void tick(int ticks = 1) {
    for (int i = 0; i < ticks; ++i) {
      kcs_player_output output{};
      kcs_player_tick(&player_, &input, &output);
      if (!stuck) std::copy_n(output.command_mm, 3, input.actual_mm);
      commands.emplace_back(output.command_mm[0], output.command_mm[1], output.command_mm[2]);
      if (feeds && commands.size() % kFeedEvery == 0) feeder_->step();
    }
  }

  Feeder& feeder() { return *feeder_; }
  kcs_player_memory& memory() { return *memory_; }
  const kcs_player_report& player() const { return player_.report; }

  kcs_player_input input{.enable = true};
  bool stuck = false;
  bool feeds = true;             // false: the gateway is dead
  std::vector<Vector> commands;  // of every tick

 private:
  PlayerMemory memory_ = make_player_memory(test_profile());
  kcs_player player_{};
  std::unique_ptr<Feeder> feeder_;
};

}  // namespace kcs::gateway
