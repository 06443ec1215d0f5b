#include "server/planning/blended.h"

#include <algorithm>
#include <cmath>

#include "server/planning/corner_sides.h"
#include "server/planning/corner_strain.h"
#include "server/planning/search.h"

namespace kcs::planning {
namespace {

// A swing begins on the leg with acceleration a1 across it and no velocity. At jerk j it goes down for (1 + α) a1/j, up
// for (α + β) a1/j, down for β a1/j and ends in rest across the leg, on it. Meanwhile it is at most kSwingHeight·a1³/j²
// away from the leg, never beyond it, and at most a1²/(2j) fast across it.
constexpr double kAlpha = 0.99505719436409143, kBeta = 0.70009915016070204;
constexpr double kSwingHeight = 0.66666670722119497;

// The largest share of a velocity limit or of the feed for the swing: the rest is for the way along the leg.
constexpr double kSwingSpeed = 0.25;

double square(double x) { return x * x; }

// The least that `of` finds on the two sides.
template <class Function>
double on_both(const CornerSides& sides, Function of) {
  return std::min(of(sides.in), of(sides.out));
}

// What the corner may use. mm/s, mm/s², mm/s³
struct Means {
  Means(const CornerGeometry& corner, const CornerSides& sides, const AxisLimits& limits, double share)
      : feed(std::min(corner.in.feed, corner.out.feed)),
        along_acceleration(std::min(corner.in.acceleration, corner.out.acceleration)),
        across_acceleration(along(limits.acceleration, corner.difference, limits.axes) * 2 * corner.half_sine *
                            corner.half_cosine),
        along_jerk(share * std::min(corner.in.jerk, corner.out.jerk)),
        across_jerk(on_both(
            sides, [&](const CornerSide& side) { return side.left_across(limits.jerk, along_jerk, limits.axes); })),
        across_speed(std::min(feed, on_both(sides, [&](const CornerSide& side) {
                                return side.left_across(limits.velocity, 0, limits.axes);
                              }))) {}

  double feed;
  double along_acceleration;   // on both legs
  double across_acceleration;  // in the middle, together with what goes along
  double along_jerk, across_jerk;
  double across_speed;
};

// a1, mm/s²
double swing_acceleration(const CornerGeometry& corner, const Means& means, double share_of_greatest) {
  // The last one lets the tool build its acceleration along the leg down again before it is at the feed.
  return share_of_greatest *
         std::min(
             {std::cbrt(corner.tolerance * square(means.across_jerk) / kSwingHeight), means.across_acceleration,
              std::sqrt(2 * means.across_jerk * kSwingSpeed * means.across_speed),
              std::sqrt((1 - kSwingSpeed) * means.along_jerk * means.feed) * corner.half_cosine / corner.half_sine});
}

// The greatest speed along the leg, mm/s, when the tool moves at `across` (mm/s) across it.
double top_speed(const Means& means, const CornerSides& sides, const AxisLimits& limits, double across) {
  return std::min(std::sqrt(square(means.feed) - square(across)), on_both(sides, [&](const CornerSide& side) {
                    return side.left_along(limits.velocity, across, limits.axes);
                  }));
}

// From the end of the hold to the leg, as motion across it.
struct Turn {
  double swing;                                                                // a1, at the end
  double jerk;                                                                 // mm/s³
  double time = 0;                                                             // s
  double acceleration() const { return swing + jerk * time; }                  // a0
  double approach() const { return time * (swing + jerk * time / 2); }         // towards the leg, mm/s
  double way() const { return square(time) * (swing / 2 + jerk * time / 6); }  // mm
};

// As hard as the tolerance, the axes and the feed (`top` along the leg) allow.
Turn hardest_turn(const CornerGeometry& corner, const Means& means, double swing, double top) {
  Turn turn{.swing = swing, .jerk = means.across_jerk};
  const double way = corner.cut * corner.half_cosine, cotangent = corner.half_cosine / corner.half_sine;
  constexpr double kUnused = 1e-9;  // share of the way
  turn.time = largest_fitting(0, std::cbrt(6 * way / turn.jerk), kUnused * way, [&](double time) {
    return Turn{swing, turn.jerk, time}.way() - way;
  });
  // approach()·cotangent is the speed along the leg, acceleration()/cotangent the acceleration.
  const double by_feed = std::sqrt((top + square(swing) * cotangent / (2 * turn.jerk)) /
                                   (cotangent / (2 * turn.jerk) + 1 / (2 * means.along_jerk * square(cotangent))));
  const double most = std::min(means.across_acceleration, by_feed);
  turn.time = std::min(turn.time, std::max(0.0, most - swing) / turn.jerk);
  return turn;
}

}  // namespace

bool Blended::suits(const CornerGeometry& corner) {
  constexpr double kNearlyStraight = 1e-3;  // sine of half the angle: 0.1°
  return corner.half_sine > kNearlyStraight && corner.half_cosine > kReversal;
}

Blended::Blended(const CornerGeometry& corner, const AxisLimits& limits, const Blend& blend) {
  const CornerSides sides(corner);
  const Means means(corner, sides, limits, blend.share);
  const double cotangent = corner.half_cosine / corner.half_sine;
  const double swing = swing_acceleration(corner, means, blend.swing);
  const double top = top_speed(means, sides, limits, square(swing) / (2 * means.across_jerk));
  const Turn turn = hardest_turn(corner, means, swing, top);
  const double along_acceleration = turn.acceleration() / cotangent;
  acceleration_ = turn.acceleration() / corner.half_cosine;
  approach_ = turn.approach() / corner.half_cosine;
  gain_ = acceleration_ / corner.half_sine;

  // The hold: for what is left of the tolerance, but no faster than the feed.
  const double left = std::max(0.0, corner.cut * corner.half_cosine - turn.way());
  const double by_cut =
      2 * left / (turn.approach() + std::sqrt(square(turn.approach()) + 2 * turn.acceleration() * left));
  const double unheld_speed = turn.approach() * cotangent;  // along the leg, where the turn begins
  const double by_feed = (top - square(along_acceleration) / (2 * means.along_jerk) - unheld_speed) / gain_;
  max_hold_ = std::max(0.0, std::min(by_cut, by_feed));

  const double unit = swing / turn.jerk;
  across_ = {motion::LinearPhase{turn.time + (1 + kAlpha) * unit, -turn.jerk},
             motion::LinearPhase{(kAlpha + kBeta) * unit, turn.jerk}, motion::LinearPhase{kBeta * unit, -turn.jerk}};
  const double speed = unheld_speed + gain_ * max_hold_;
  along_ = motion::jlap(speed, along_acceleration, top, 0, std::max(along_acceleration, means.along_acceleration),
                        means.along_jerk);

  // As if without hold: the end is slower by what the hold would have added, all the time.
  const HalfCorner half(along_, across_);
  HalfState end{{0, unheld_speed, along_acceleration}, {turn.way(), -turn.approach(), turn.acceleration()}};
  end.along.position = end.across.position / cotangent;
  for (const HalfPhase& phase : half.phases()) end = end.after(phase);
  unheld_ = {.speed = end.along.velocity,
             .acceleration = std::max(0.0, end.along.acceleration),
             .length = end.along.position,
             .duration = 2 * (across_[0].duration + across_[1].duration + across_[2].duration),
             .cut = turn.way() / corner.half_cosine};
  const Strain strain = strain_of(corner, sides, limits, end_of_hold(corner, max_hold_), half);
  shorten(std::min({1.0, 1 / strain.acceleration, 1 / std::sqrt(strain.speed)}));
}

void Blended::shorten(double ratio) {
  const double ratio2 = square(ratio), ratio3 = ratio * ratio2;
  for (motion::Jlap* profile : {&along_, &across_}) {
    for (motion::LinearPhase& phase : *profile) phase.duration *= ratio;
  }
  acceleration_ *= ratio;
  approach_ *= ratio2;
  gain_ *= ratio;
  max_hold_ *= ratio;
  unheld_ = {.speed = unheld_.speed * ratio2,
             .acceleration = unheld_.acceleration * ratio,
             .length = unheld_.length * ratio3,
             .duration = unheld_.duration * ratio,
             .cut = unheld_.cut * ratio3};
}

CornerMotion Blended::at(double speed) const {
  if (speed < unheld_.speed) {
    const double ratio = std::sqrt(speed / unheld_.speed), ratio3 = ratio * ratio * ratio;
    return {.speed = speed,
            .acceleration = unheld_.acceleration * ratio,
            .length = unheld_.length * ratio3,
            .duration = unheld_.duration * ratio,
            .cut = unheld_.cut * ratio3};
  }
  const double hold = (speed - unheld_.speed) / gain_;
  return {.speed = speed,
          .acceleration = unheld_.acceleration,
          .length = unheld_.length + gain_ * hold * (approach_ / acceleration_ + half_time() + hold),
          .duration = unheld_.duration + 2 * hold,
          .cut = unheld_.cut + hold * (approach_ + hold * acceleration_ / 2)};
}

double Blended::speed_at_level(double level, double leg_jerk) const {
  const double unheld_level = unheld_.level(leg_jerk);
  if (level < unheld_level) return level * (unheld_.speed / unheld_level);
  return level - (unheld_level - unheld_.speed);
}

HalfState Blended::end_of_hold(const CornerGeometry& corner, double hold) const {
  const double sine = corner.half_sine, cosine = corner.half_cosine;
  const double cut = unheld_.cut + hold * (approach_ + hold * acceleration_ / 2);
  const double middle_speed = (approach_ + hold * acceleration_) * cosine / sine;  // square to the bisector
  return {.along = {cut * sine + hold * (middle_speed * cosine + hold * acceleration_ * sine / 2),
                    middle_speed * cosine + hold * acceleration_ * sine, acceleration_ * sine},
          .across = {unheld_.cut * cosine, -approach_ * cosine, acceleration_ * cosine}};
}

void Blended::append_phases(const CornerGeometry& corner, double speed, std::vector<motion::Phase>& phases) const {
  Blended slower = *this;
  if (speed < unheld_.speed) slower.shorten(std::sqrt(speed / unheld_.speed));
  const double hold = speed < unheld_.speed ? 0 : (speed - unheld_.speed) / gain_;
  const HalfCorner half(slower.along_, slower.across_);
  std::vector<HalfState> states{slower.end_of_hold(corner, hold)};
  for (const HalfPhase& phase : half.phases()) states.push_back(states.back().after(phase));

  const CornerSides sides(corner);
  for (std::size_t i = half.phases().size(); i-- > 0;) {
    const HalfPhase& phase = half.phases()[i];
    phases.push_back(
        {.duration = phase.duration, .start = sides.in.state(states[i + 1]), .jerk = sides.in.jerk(phase)});
  }
  if (hold > 0) phases.push_back({.duration = 2 * hold, .start = sides.in.state(states[0])});
  for (std::size_t i = 0; i < half.phases().size(); ++i) {
    const HalfPhase& phase = half.phases()[i];
    phases.push_back({.duration = phase.duration, .start = sides.out.state(states[i]), .jerk = sides.out.jerk(phase)});
  }
}

}  // namespace kcs::planning
