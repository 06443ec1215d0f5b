#include "server/planning/first_draft.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace kcs::planning {
namespace {

constexpr double kShareOfAcceleration = 0.5, kShareOfOwn = 0.6;
constexpr double kSlowest = 1e-3;   // mm/s
constexpr double kStraight = 1e-6;  // |D| of a corner that is none
// A corner's turn is spread over so many tolerances of the way at least.
constexpr double kSpread = 4;
// How much the path turns is seen over so many tolerances of the way on either side: a jog of less is hardly a corner.
constexpr double kSeen = 2;
// What the search begins with: points are held firmly enough to stay near to corners.
constexpr double kPlace = 1e-3, kJerk = 1, kAcceleration = 1e-4;

// A part of the draft between two corners, or the ends.
struct Part {
  double from, to;    // ways, mm
  double start, end;  // speeds, mm/s
  double feed;
  double acceleration;  // mm/s²
};

class Draft {
 public:
  Draft(const StretchPath& path, const motion::AxisLimits& limits, const MotionRange& range, double step)
      : path_(path), limits_(limits), range_(range), step_(step) {}

  MotionDraft run() {
    divide();
    for (std::size_t i = 0; i < parts_.size(); ++i) {
      if (i > 0) parts_[i].start = parts_[i - 1].end;
      parts_[i].end = std::min(parts_[i].end, reached(parts_[i].start, parts_[i]));
    }
    for (std::size_t i = parts_.size(); i-- > 0;) {
      if (i + 1 < parts_.size()) parts_[i].end = parts_[i + 1].start;
      parts_[i].start = std::min(parts_[i].start, reached(parts_[i].end, parts_[i]));
    }
    return sample();
  }

 private:
  // What all axes allow or, of what those allow that move, a share: rather too slow than too fast.
  double roughly(const Vector& limit, const Vector& direction) const {
    return std::max(limit.head(static_cast<Eigen::Index>(limits_.axes)).minCoeff(),
                    kShareOfOwn * roughly_along(limit, direction, limits_.axes));
  }
  double acceleration(const Vector& direction) const {
    return kShareOfAcceleration * roughly(limits_.acceleration, direction);
  }

  static double reached(double speed, const Part& part) {
    return std::sqrt(speed * speed + 2 * part.acceleration * (part.to - part.from));
  }

  void divide() {
    const auto legs = path_.legs();
    std::size_t leg = path_.leg_at(range_.from);
    double from = range_.from, speed = range_.at_most.entry;
    for (; leg + 1 < legs.size() && path_.way(leg + 1) < range_.to; ++leg) {
      const double corner = corner_speed(leg);
      parts_.push_back({from, path_.way(leg + 1), speed, corner, legs[leg].feed, acceleration(legs[leg].direction)});
      from = path_.way(leg + 1);
      speed = corner;
    }
    parts_.push_back({from, range_.to, speed, range_.at_most.exit, legs[leg].feed, acceleration(legs[leg].direction)});
  }

  // At the end of the leg: that of a corner with interrupted acceleration, or of a bend if it is one of many.
  double corner_speed(std::size_t leg) const {
    const Leg &in = path_.legs()[leg], &out = path_.legs()[leg + 1];
    const double tolerance = std::min(in.tolerance, out.tolerance), seen = kSeen * tolerance;
    const Vector around = turn_around(leg, seen), across = around.normalized();
    const double turn = std::max(kStraight, around.norm());
    const double jerk = roughly(limits_.jerk, across);
    const double time = std::cbrt(6 * tolerance / (turn * jerk));
    const double length = std::max(seen, (in.length + out.length) / 2) + kSpread * tolerance;
    return std::min({jerk * time * time / turn, std::sqrt(acceleration(across) * length / turn), in.feed, out.feed});
  }

  // D of the corner at the end of the leg, if only so much of the path is seen on either side, mm.
  Vector turn_around(std::size_t leg, double seen) const {
    const double way = path_.way(leg + 1);
    const auto at = [&](double place) { return path_.at(path_.leg_at(place, leg), place); };
    const Vector& corner = path_.corners()[leg + 1];
    const Vector before = corner - at(way - seen), after = at(way + seen) - corner;
    return after.normalized() - before.normalized();
  }

  MotionDraft sample() const {
    std::vector<Profile> profiles;
    profiles.reserve(parts_.size());
    double duration = 0;
    for (const Part& part : parts_) duration += profiles.emplace_back(profile(part)).total();
    if (!(duration <= kMostPoints * step_)) return {};
    MotionDraft draft{.step = step_};
    const double in = parts_.front().start * step_;
    draft.ways = {range_.from - in, range_.from};
    double time = step_;  // of the next way, since the start of the part
    for (std::size_t i = 0; i < parts_.size(); ++i) time = sample_part(parts_[i], profiles[i], time, draft.ways);
    const double out = parts_.back().end * step_;
    while (draft.ways.size() < 6) draft.ways.push_back(range_.to);
    draft.ways.insert(draft.ways.end(), {range_.to - out, range_.to, range_.to + out});
    const std::size_t size = draft.ways.size();
    draft.weights = {std::vector(size, kPlace), std::vector(size, kAcceleration),
                     std::vector<Vector>(size, Vector::Constant(kJerk))};
    return draft;
  }

  // How the speed changes along a part: up to a peak and down again.
  struct Profile {
    double peak, up_time, up, cruise, down_time;  // mm/s, s, mm, s, s
    double total() const { return up_time + cruise + down_time; }
  };
  Profile profile(const Part& part) const {
    const double length = part.to - part.from;
    const double mean = (part.start * part.start + part.end * part.end) / 2;
    const double peak =
        std::max({std::min(part.feed, std::sqrt(mean + part.acceleration * length)), part.start, part.end, kSlowest});
    const double up_time = (peak - part.start) / part.acceleration, down_time = (peak - part.end) / part.acceleration;
    const double up = up_time * (peak + part.start) / 2, down = down_time * (peak + part.end) / 2;
    return {peak, up_time, up, std::max(0.0, length - up - down) / peak, down_time};
  }

  // Returns what is left of the last step.
  double sample_part(const Part& part, const Profile& profile, double time, std::vector<double>& ways) const {
    const double length = part.to - part.from;
    const double total = profile.total();
    while (time < total) {
      const double left = total - time;
      double way = profile.up + (time - profile.up_time) * profile.peak;
      if (time < profile.up_time) way = time * (part.start + part.acceleration * time / 2);
      if (left < profile.down_time) way = length - left * (part.end + part.acceleration * left / 2);
      ways.push_back(part.from + std::clamp(way, 0.0, length));
      time += step_;
    }
    return time - total;
  }

  const StretchPath& path_;
  const motion::AxisLimits& limits_;
  const MotionRange& range_;
  double step_;
  std::vector<Part> parts_;
};

}  // namespace

MotionDraft first_draft(const StretchPath& path, const motion::AxisLimits& limits, const MotionRange& range,
                        double step) {
  return Draft(path, limits, range, step).run();
}

}  // namespace kcs::planning
