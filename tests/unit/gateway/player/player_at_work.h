// A player with its memory, drives that follow at once, and a program of batches along a line.
#pragma once

#include <memory>
#include <vector>

#include "client/gateway/player/player.h"
#include "tests/line_motion/limit_watch.h"
#include "tests/line_motion/line_motion.h"

namespace kcs::test {

// What rounding adds to a share of a limit: of the third difference of positions about 1000 mm from 0.
inline constexpr double kAtTheLimit = 1 + 1e-5;

class PlayerAtWork {
 public:
  static constexpr double kPeriodS = 1e-3;
  static constexpr unsigned kBatch = 20;
  static constexpr double kLengthMm = 100;

  // Stands at the beginning of the line, switched off. Everything public may be turned while it works.
  PlayerAtWork();

  void tick(int ticks = 1);
  // The machine was moved by hand: from here the limits are judged anew.
  void watch_again() { watch = LimitWatch(profile); }
  // Ticks until the player is in that state; false after a minute of its time.
  bool tick_until(kcs_player_state state);
  // Switches on, and waits for READY.
  void switch_on();
  // Puts batches of the program, so that two wait beyond the one that is played, and ticks, until the state is there.
  bool feed_until(kcs_player_state state);
  bool feed(std::uint64_t ticks);

  // The program's next batch, put or only written.
  bool put_next();
  std::unique_ptr<kcs_player_batch> next();
  bool put(const kcs_player_batch& batch);
  // A batch that stands where the player does, and would come next.
  std::unique_ptr<kcs_player_batch> standing(std::uint32_t setpoints, std::uint32_t tail) const;
  // The program goes on from where the player rests, with its branch; or begins anew as another run.
  void resume();
  void begin_run(std::uint64_t run);

  const kcs_player_report& report() const { return player->report; }
  kcs_player_state state() const { return static_cast<kcs_player_state>(report().state); }
  kcs_player_reason reason() const { return static_cast<kcs_player_reason>(report().reason); }
  double place() const { return line.place_of(output.command_mm); }

  Line line{.origin = {1000, -20, 0}};  // far from 0: rounding is at its worst there
  LineLimits limits;
  kcs_player_profile profile = line.profile(limits, kPeriodS);
  std::unique_ptr<kcs_player_memory> memory = std::make_unique<kcs_player_memory>();
  std::unique_ptr<kcs_player> player = std::make_unique<kcs_player>();
  LineRun run{line, limits, kPeriodS, kBatch, kLengthMm};
  kcs_player_input input{};
  kcs_player_output output{};
  LimitWatch watch{profile};
  std::vector<kcs_player_marker> markers;
};

}  // namespace kcs::test
