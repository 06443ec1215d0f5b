#include "server/motion/jlap.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace kcs::motion {
namespace {

// The profile whose acceleration goes up first: a_start → peak → a_end. None if the peak would have to lie below one
// of the two.
// v_rounding: what dv may be off by.
std::optional<Jlap> upward(double dv, double v_rounding, double a_start, double a_end, double a_max, double j_max) {
  const double square = j_max * dv + (a_start * a_start + a_end * a_end) / 2;
  if (square < 0) return std::nullopt;
  double peak = std::min(std::sqrt(square), a_max);
  const double least = std::max(a_start, a_end);
  if (peak < least) {
    const double rounding = 1e-12 * (std::abs(a_start) + std::abs(a_end)) + v_rounding * j_max / std::abs(least);
    if (peak < least - rounding) return std::nullopt;
    peak = least;  // rather the speed off by a rounding than the acceleration
  }
  const double t1 = (peak - a_start) / j_max;
  const double t3 = (peak - a_end) / j_max;
  double t2 = 0;
  if (peak > 0) t2 = std::max(0.0, (dv - (2 * peak * peak - a_start * a_start - a_end * a_end) / (2 * j_max)) / peak);
  return Jlap{LinearPhase{t1, j_max}, LinearPhase{t2, 0}, LinearPhase{t3, -j_max}};
}

double total(const Jlap& profile) { return profile[0].duration + profile[1].duration + profile[2].duration; }

}  // namespace

LinearState LinearPhase::end(const LinearState& start) const {
  const double t = duration;
  return {start.position + t * (start.velocity + t * (start.acceleration / 2 + t * jerk / 6)),
          start.velocity + t * (start.acceleration + t * jerk / 2), start.acceleration + t * jerk};
}

Jlap jlap(double v_start, double a_start, double v_end, double a_end, double a_max, double j_max) {
  const double dv = v_end - v_start;
  const double v_rounding = 4 * std::numeric_limits<double>::epsilon() * (std::abs(v_start) + std::abs(v_end));
  const auto up = upward(dv, v_rounding, a_start, a_end, a_max, j_max);
  auto down = upward(-dv, v_rounding, -a_start, -a_end, a_max, j_max);
  if (down) {
    for (auto& phase : *down) phase.jerk = -phase.jerk;
  }
  if (up && down) return total(*up) <= total(*down) ? *up : *down;
  if (up) return *up;
  if (down) return *down;
  // Neither, by rounding alone: the immediate transition reaches v_end.
  return {LinearPhase{std::abs(a_end - a_start) / j_max, std::copysign(j_max, a_end - a_start)}, {}, {}};
}

Ramp ramp_to_peak(double v, double a, double v_peak, double a_max, double j_max) {
  const double dv = std::max(0.0, v_peak - v);
  const double peak = std::clamp(std::sqrt(j_max * dv + a * a / 2), a, std::max(a, a_max));
  const double t1 = (peak - a) / j_max;
  const double t3 = peak / j_max;
  const double t2 = peak > 0 ? std::max(0.0, (dv - (2 * peak * peak - a * a) / (2 * j_max)) / peak) : 0.0;
  const double v1 = v + t1 * (a + peak) / 2;
  const double distance =
      t1 * (v + t1 * (a / 2 + t1 * j_max / 6)) + t2 * (v1 + t2 * peak / 2) + t3 * (v_peak - t3 * t3 * j_max / 6);
  return {distance, t1 + t2 + t3};
}

}  // namespace kcs::motion
