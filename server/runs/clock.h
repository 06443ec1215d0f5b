// The plan's time as a function of the machine's: how holds and overrides change the pace and never the path. While the
// plan dwells, nothing moves and the clock may jump: there it goes as planned.
#pragma once

namespace kcs::runs {

// At one instant.
struct ClockState {
  double plan_time = 0;    // s, since the start of the plan
  double rate = 0;         // plan seconds per second, ≥ 0; 1: as planned
  double rate_change = 0;  // 1/s

  bool rests() const { return rate == 0 && rate_change == 0; }
};

// A stretch of machine time during which the second derivative of the rate is constant.
struct ClockPhase {
  ClockState start;
  double bend = 0;      // 1/s²
  double duration = 0;  // s

  // The state `time` seconds after the start of the phase.
  ClockState at(double time) const {
    const double half_square = time * time / 2;
    return {start.plan_time + time * start.rate + half_square * start.rate_change + half_square * time / 3 * bend,
            start.rate + time * start.rate_change + half_square * bend, start.rate_change + time * bend};
  }
  ClockState end() const { return at(duration); }

  double lowest_rate() const;

  // When the clock, which must not go back, comes to `plan_time`, s after the start of the phase; between `low` and
  // `high`.
  double time_of(double plan_time, double low, double high) const;
};

}  // namespace kcs::runs
