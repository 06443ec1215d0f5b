// Motion along a line, from rest to rest and from any instant of that to rest: what the tests of the player feed it.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "client/gateway/player/player.h"

namespace kcs::test {

// Along the line: mm, mm/s, mm/s², and the limits of it, mm/s, mm/s², mm/s³.
struct LineState {
  double place = 0, velocity = 0, acceleration = 0;
};
struct LineLimits {
  double velocity = 200, acceleration = 2000, jerk = 40000;
};

// Pieces of constant jerk.
class LineMotion {
 public:
  explicit LineMotion(const LineState& start) : pieces_{{.begin_s = 0, .start = start, .jerk = 0}} {}

  // From rest at `from` to rest at `to`, which lies beyond, as fast as the limits let it.
  static LineMotion travel(double from, double to, const LineLimits& limits);
  // From a state of such a motion to rest, as soon as the limits let it.
  static LineMotion stop(const LineState& state, const LineLimits& limits);

  double duration_s() const { return duration_; }
  // Before its beginning and after its end it rests.
  LineState at(double time_s) const;

 private:
  struct Piece {
    double begin_s;
    LineState start;
    double jerk;
  };
  void add(double duration_s, double jerk);

  std::vector<Piece> pieces_;
  double duration_ = 0;
};

// The line in space: axes move by `direction` times the place, from `origin`.
struct Line {
  std::array<double, 3> origin = {0, 0, 0};
  std::array<double, 3> direction = {0.6, -0.64, 0.48};

  std::array<double, 3> at(double place) const;
  double place_of(const double* position_mm) const;
  // How far beside the line a position is, mm.
  double distance_to(const double* position_mm) const;
  // What a machine must allow for motion within these limits, and nothing more.
  kcs_player_profile profile(const LineLimits& limits, double period_s) const;
};

// A program that sends the batches of a run along a line, one after the other.
class LineRun {
 public:
  LineRun(const Line& line, const LineLimits& limits, double period_s, unsigned batch, double length_mm)
      : line_(line), limits_(limits), period_s_(period_s), batch_(batch), length_(length_mm), motion_(LineState{}) {}

  // Goes on from rest at `place` with that branch.
  void begin(std::uint64_t run, std::uint64_t branch, std::uint64_t first_tick, double place);
  // No batch is left: the one that ends the run has been written.
  bool over() const { return over_; }
  void write(kcs_player_batch& batch);

 private:
  Line line_;
  LineLimits limits_;
  double period_s_;
  unsigned batch_;
  double length_;
  LineMotion motion_;
  std::uint64_t run_ = 0, branch_ = 0, first_tick_ = 0, ticks_ = 0;
  bool over_ = true;
};

}  // namespace kcs::test
