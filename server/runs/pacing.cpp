#include "server/runs/pacing.h"

#include <algorithm>
#include <cmath>

namespace kcs::runs {
namespace {

constexpr double kLandingSteps = 4;  // so near to the end one bend leads to it
constexpr double kReserve = 1e-3;    // of the rate, so that this one bend is found
constexpr double kMostBend = 0.25;   // the rate goes from 0 to 1 in four steps at least
constexpr int kHalvings = 6;         // in the search for the hardest bend
// How far is looked ahead, in steps.
constexpr int kMostSteadying = 250, kMostReturning = 100;
// What rounding leaves of the rate, and of its change (1/s), where both should be gone.
constexpr double kNoRate = 1e-12, kNoRateChange = 1e-9;

}  // namespace

bool Pacing::lead(ClockCourse& course, double rate, double longest) {
  const ClockState from = course.end();
  if (plan_.phase(plan_.find(from.plan_time)).rests()) {
    dwell(course, rate, longest);
    return true;
  }
  auto stretch = next(from, rate, longest);
  if (!stretch || stretch->lowest_rate() < -kNoRate) return false;
  const double end = stretch->end().plan_time;
  for (std::size_t number = plan_.find(from.plan_time) + 1; plan_.phase(number).start_time <= end; ++number) {
    if (!plan_.phase(number).rests()) continue;
    const double begin = plan_.phase(number).start_time;
    stretch->duration = stretch->time_of(begin, 0, stretch->duration);
    course.add(*stretch, {begin, 1, 0});
    return true;
  }
  course.add(*stretch, after(*stretch, rate));
  return true;
}

void Pacing::dwell(ClockCourse& course, double rate, double longest) {
  const ClockState from{course.end().plan_time, 1, 0};
  const double end = plan_.phase(plan_.find(from.plan_time)).end_time(), left = end - from.plan_time;
  const ClockPhase stretch{from, 0, std::min(left, longest)};
  course.add(stretch, left <= longest ? ClockState{end, std::min(rate, 1.0), 0} : stretch.end());
}

std::optional<ClockPhase> Pacing::next(const ClockState& from, double rate, double longest) {
  const double gap = rate - from.rate;
  const bool arrived = gap == 0 && from.rate_change == 0;
  if (arrived && rate <= 1) return ClockPhase{from, 0, longest};
  if (!arrived) {
    if (const auto landed = landing(from, rate, longest)) return landed;
  }
  const double step = std::min(step_, longest);
  const BendRange allowed = range(from, step);
  if (allowed.empty()) return {};
  const double soft = std::clamp(-from.rate_change / step, allowed.low, allowed.high);
  const bool slower = gap < 0 || (gap == 0 && from.rate_change > 0);
  const double hard = arrived ? soft : slower ? allowed.low : allowed.high;
  if (is_safe({from, soft, step})) return hardest(from, hard, soft, rate, step);
  // Faster than planned, and the plan wants its own pace soon.
  const ClockPhase braking{from, allowed.low, step};
  return steadied(braking.end()) ? braking : ClockPhase{from, soft, step};
}

// The state after a stretch towards `rate`: exactly at the rate if that is where it leads.
ClockState Pacing::after(const ClockPhase& stretch, double rate) {
  const ClockState end = stretch.end();
  if (std::abs(end.rate - rate) > kNoRate || std::abs(end.rate_change) > kNoRateChange) return end;
  return {end.plan_time, rate, 0};
}

BendRange Pacing::range(const ClockState& state, double step) {
  return bend_range(plan_, limits_, state, step, share_, kMostBend / (step_ * step_));
}

// One bend, or from a steady rate two, that end at the rate itself.
std::optional<ClockPhase> Pacing::landing(const ClockState& from, double rate, double longest) {
  const double gap = rate - from.rate;
  if (from.rate_change == 0) {
    const ClockPhase half{from, gap / (step_ * step_), step_};
    if (longest < 2 * step_ || !holds(half) || !holds({half.end(), -half.bend, step_})) return {};
    return is_safe(half) ? std::optional(half) : std::nullopt;
  }
  const double time = 2 * gap / from.rate_change;
  if (!(time > 0 && time <= kLandingSteps * step_)) return {};
  ClockPhase phase{from, -from.rate_change / time, time};
  if (!holds(phase) || (rate > 1 && !returns_to_plan(after(phase, rate)))) return {};
  phase.duration = std::min(phase.duration, longest);
  return phase;
}

// Between a hard bend and a safe soft one, the hardest safe one.
ClockPhase Pacing::hardest(const ClockState& from, double hard, double soft, double rate, double step) {
  if (is_safe({from, hard, step}, rate)) return {from, hard, step};
  for (int i = 0; i < kHalvings; ++i) {
    const double middle = (hard + soft) / 2;
    (is_safe({from, middle, step}, rate) ? soft : hard) = middle;
  }
  return {from, soft, step};
}

bool Pacing::holds(ClockPhase phase) {
  while (phase.duration > 0) {
    const double step = std::min(step_, phase.duration);
    const BendRange allowed = range(phase.start, step);
    if (phase.bend < allowed.low || phase.bend > allowed.high) return false;
    phase.start = phase.at(step);
    phase.duration -= step;
  }
  return true;
}

// Where the change of the rate has died down, as fast as possible; nothing if it cannot.
std::optional<ClockState> Pacing::steadied(ClockState state) {
  for (int i = 0; i < kMostSteadying; ++i) {
    if (state.rate < 0) return {};
    if (state.rate_change == 0) return state;
    const BendRange allowed = range(state, step_);
    if (allowed.empty()) return {};
    const double wanted = -state.rate_change / step_, bend = std::clamp(wanted, allowed.low, allowed.high);
    state = ClockPhase{state, bend, step_}.end();
    if (bend == wanted) state.rate_change = 0;
  }
  return {};
}

// From a rate above 1 it can be led to one that is inside the limits for ever.
bool Pacing::returns_to_plan(ClockState state) {
  for (int i = 0; i < kMostReturning; ++i) {
    if (state.rate <= 1 && state.rate_change == 0) return true;
    const BendRange allowed = range(state, step_);
    if (allowed.empty()) return false;
    const ClockState braking = ClockPhase{state, allowed.low, step_}.end();
    if (const auto steady = steadied(braking)) {
      if (steady->rate <= 1) return true;
      state = braking;
    } else {
      state = ClockPhase{state, std::clamp(-state.rate_change / step_, allowed.low, allowed.high), step_}.end();
    }
  }
  return false;
}

// The rate can be steadied after it, and kept.
bool Pacing::is_safe(const ClockPhase& phase) {
  const auto steady = steadied(phase.end());
  return steady && (steady->rate <= 1 || returns_to_plan(phase.end()));
}

// And it does not pass the wanted one meanwhile.
bool Pacing::is_safe(const ClockPhase& phase, double rate) {
  const double gap = rate - phase.start.rate;
  const double reserve = std::min(kReserve, std::abs(gap) / 2);
  const auto steady = steadied(phase.end());
  if (!steady || (gap < 0 ? steady->rate < rate + reserve : steady->rate > rate - reserve)) return false;
  return steady->rate <= 1 || returns_to_plan(phase.end());
}

}  // namespace kcs::runs
