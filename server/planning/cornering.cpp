#include "server/planning/cornering.h"

#include <algorithm>
#include <array>
#include <limits>

#include "server/planning/leg_profile.h"
#include "server/planning/search.h"

namespace kcs::planning {
namespace {

template <class... Functions>
struct Overloaded : Functions... {
  using Functions::operator()...;
};
template <class... Functions>
Overloaded(Functions...) -> Overloaded<Functions...>;

// Time from the middle of a leg to the corner, or from the corner to the middle, if the leg's other end had a corner
// like this one.
double half_leg_time(const Leg& leg, const CornerMotion& motion) {
  const LegEnd end = leg_end(motion, leg);
  const double way = leg.length - 2 * motion.length;
  const double peak = peak_speed(leg, end, end, way);
  const motion::Ramp ramp = ramp_from(leg, end, peak);
  return ramp.duration + std::max(0.0, way / 2 - ramp.distance) / peak;
}

// How much longer the leg would have to be if its other end had a corner like this one, mm.
double excess(const Leg& leg, const CornerMotion& motion) {
  const LegEnd end = leg_end(motion, leg);
  return 2 * (motion.length + ramp_from(leg, end, end.level).distance) - leg.length;
}

// A trial may leave this share of a leg unused.
constexpr double kTrialShare = 1e-6;

// Time over both half legs with the corner as fast as they let it be.
double trial_time(const CornerGeometry& corner, const Cornering& cornering) {
  const double slack = kTrialShare * std::min(corner.in.length, corner.out.length);
  const double speed = largest_fitting(0, cornering.max_speed(), slack, [&](double v) {
    const CornerMotion motion = cornering.at(v);
    return std::max(excess(corner.in, motion), excess(corner.out, motion));
  });
  const CornerMotion motion = cornering.at(speed);
  return half_leg_time(corner.in, motion) + motion.duration + half_leg_time(corner.out, motion);
}

// The blend that takes the least time, of a few: around the best one the time hardly changes.
Cornering fastest_blend(const CornerGeometry& corner, const AxisLimits& limits) {
  constexpr std::array kShares{0.1, 0.2, 0.3, 0.4, 0.5, 0.625, 0.75, 0.875, 0.99};
  constexpr std::array kSwings{0.0, 0.5, 1.0};
  Cornering best;
  double best_time = std::numeric_limits<double>::infinity();
  for (const double swing : kSwings) {
    for (const double share : kShares) {
      const Cornering tried{Blended(corner, limits, {share, swing})};
      const double time = trial_time(corner, tried);
      if (time < best_time) {
        best = tried;
        best_time = time;
      }
    }
  }
  return best;
}

// At the feed all the way, as the way through an interrupted corner is as long as its legs are there.
bool loses_nothing(const CornerGeometry& corner, const Cornering& interrupted) {
  const double speed = interrupted.max_speed();
  const CornerMotion motion = interrupted.at(speed);
  return speed >= std::max(corner.in.feed, corner.out.feed) && excess(corner.in, motion) <= 0 &&
         excess(corner.out, motion) <= 0;
}

// The one of the two that takes less time; the first, if both take the same.
const Cornering& faster(const CornerGeometry& corner, const Cornering& first, const Cornering& second) {
  return trial_time(corner, first) <= trial_time(corner, second) ? first : second;
}

}  // namespace

double Cornering::max_speed() const {
  return std::visit(
      Overloaded{[](const ExactStop&) { return 0.0; }, [](const Passage& way) { return way.speed; },
                 [](const Settled& way) { return way.motion.speed; }, [](const auto& way) { return way.max_speed(); }},
      way_);
}

CornerMotion Cornering::at(double speed) const {
  return std::visit(
      Overloaded{[](const ExactStop&) { return CornerMotion{}; },
                 [&](const Passage&) { return CornerMotion{.speed = speed}; },
                 [](const Settled& way) { return way.motion; }, [&](const auto& way) { return way.at(speed); }},
      way_);
}

double Cornering::speed_at_level(double level, double leg_jerk) const {
  return std::visit(
      Overloaded{[](const ExactStop&) { return 0.0; }, [&](const Passage& way) { return std::min(way.speed, level); },
                 [](const Settled& way) { return way.motion.speed; },
                 [&](const auto& way) { return std::min(way.max_speed(), way.speed_at_level(level, leg_jerk)); }},
      way_);
}

void Cornering::append_phases(const CornerGeometry& corner, double speed, std::vector<motion::Phase>& phases) const {
  std::visit(Overloaded{[](const ExactStop&) {}, [](const Passage&) {}, [](const Settled&) {},
                        [&](const auto& way) { way.append_phases(corner, speed, phases); }},
             way_);
}

CornerStrategy Cornering::strategy() const {
  if (std::holds_alternative<ExactStop>(way_)) return CornerStrategy::kExactStop;
  if (std::holds_alternative<Blended>(way_)) return CornerStrategy::kBlended;
  return std::holds_alternative<Uninterrupted>(way_) ? CornerStrategy::kUninterrupted : CornerStrategy::kInterrupted;
}

Cornering choose_cornering(const CornerGeometry& corner, CornerStrategy strategy, const AxisLimits& limits) {
  if (corner.straight) return Cornering(Passage{std::min(corner.in.feed, corner.out.feed)});
  if (strategy == CornerStrategy::kExactStop || corner.cut == 0) return {};
  const Cornering interrupted{Interrupted(corner, limits)};
  if (strategy == CornerStrategy::kInterrupted) return interrupted;
  if (strategy == CornerStrategy::kAuto && loses_nothing(corner, interrupted)) return interrupted;
  const Cornering uninterrupted{Uninterrupted(corner, limits)};
  if (strategy == CornerStrategy::kUninterrupted) return uninterrupted;
  const Cornering& paper = faster(corner, interrupted, uninterrupted);
  if (!Blended::suits(corner)) return paper;
  const Cornering blended = fastest_blend(corner, limits);
  return strategy == CornerStrategy::kBlended ? blended : faster(corner, paper, blended);
}

}  // namespace kcs::planning
