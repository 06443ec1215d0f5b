#include "server/planning/stage.h"

#include <algorithm>
#include <utility>

#include "server/planning/leg_profile.h"

namespace kcs::planning {
namespace {

// A stretch begins and ends where the tool may be at the feed: this much farther from its first (and last) corner than
// it would need for that corner alone.
constexpr double kMoreRoom = 0.3;
// Where two stretches share a leg, each leaves it this share of what neither needs.
constexpr double kShareOfSlack = 0.4;
// Where a leg has not even room for both, each takes this share of its part of it.
constexpr double kShareOfTight = 0.9;

// Where the path goes back on itself, places on it cannot be told apart: a stretch ends there, at rest. This is cos
// 85°.
constexpr double kReversal = 0.087;

// A stretch begins and ends with this many steps of time on a line at least.
constexpr double kLeastSteps = 3;

// A leg of more steps than this at the feed is worth corners of its own: it costs more than it can win.
constexpr double kMostSteps = 50;

class StageMaker {
 public:
  StageMaker(const LegPath& path, std::set<std::size_t>& alone, const PlanOptions& options)
      : path_(path), alone_(alone), options_(options) {
    for (std::size_t i = 0; i + 1 < path.legs.size(); ++i) {
      if (options.strategy == CornerStrategy::kAuto) {
        add_needs(i);
      } else {
        needs_.push_back({0, 0, false});
      }
    }
    for (std::size_t i = 1; i < needs_.size(); ++i) {
      needs_[i].after = std::max(needs_[i].after, needs_[i - 1].after - path.legs[i].length);
    }
    for (std::size_t i = needs_.size(); i-- > 1;) {
      needs_[i - 1].before = std::max(needs_[i - 1].before, needs_[i].before - path.legs[i].length);
    }
  }

  std::vector<Stage> run() {
    for (std::size_t leg = 0; leg < path_.legs.size();) {
      std::size_t last = leg;
      while (coupled(last)) ++last;
      if (last == leg || alone_.contains(leg) || !add_stretch(leg, last + 1)) {
        do {
          add_leg(leg);
        } while (leg++ < last);
      } else {
        leg = last + 1 + (taken_whole_ ? 1 : 0);
      }
    }
    return std::move(stages_);
  }

 private:
  // What the corners up to one need of the way after it, and those from it on of the way before it, so that the tool
  // may be at the feed beyond, mm.
  struct Needs {
    double before = 0, after = 0;
    bool smooth = false;  // it is no stop
  };

  static double need(const Leg& leg, const CornerMotion& motion) {
    const LegEnd end = leg_end(motion, leg);
    return motion.length + ramp_from(leg, end, std::max(end.level, leg.feed)).distance;
  }

  void add_needs(std::size_t i) {
    const Leg &in = path_.legs[i], &out = path_.legs[i + 1];
    CornerMotion motion;
    const double tolerance = std::min(in.tolerance, out.tolerance);
    if (!path_.joints[i].stop && tolerance > 0) {
      const CornerGeometry corner = corner_geometry(in, out, options_);
      if (corner.straight) {
        motion.speed = std::min(in.feed, out.feed);
      } else if (corner.cut > 0 && corner.half_cosine > kReversal) {
        const Interrupted alone(corner, options_.limits);
        motion = alone.at(alone.max_speed());
      }
    }
    const double room = kLeastSteps * (tolerance > 0 ? step_of_time(tolerance, options_.limits) : 0);
    needs_.push_back(
        {std::max(need(in, motion), room * in.feed), std::max(need(out, motion), room * out.feed), motion.speed > 0});
  }

  bool smooth(std::size_t i) const { return i < needs_.size() && needs_[i].smooth; }

  // The corners at the ends of legs i and i + 1 are too near to each other.
  bool coupled(std::size_t i) const {
    if (!smooth(i) || !smooth(i + 1)) return false;
    const Leg& leg = path_.legs[i + 1];
    if (leg.length > kMostSteps * leg.feed * step_of_time(leg.tolerance, options_.limits)) return false;
    return std::max(needs_[i].after + needs_[i + 1].before, need(leg, {})) > leg.length;
  }

  // What a stretch takes of a leg, mm, at whose near end it has a corner that needs `near`, and at whose far end there
  // is one that needs `far`. All of it: the stretch begins or ends where the tool rests.
  static double share(const Leg& leg, double near, double far, bool rests_far) {
    const double slack = leg.length - near - far;
    if (slack > 0) return near + std::min(kShareOfSlack * slack, kMoreRoom * near);
    return rests_far ? leg.length : kShareOfTight * leg.length * near / (near + far);
  }

  void add_leg(std::size_t i) {
    Stage stage{.leg = path_.legs[i], .first_leg = i, .last_leg = i};
    if (i + 1 < path_.legs.size() && !path_.joints[i].stop) {
      stage.exit = choose_cornering(corner_geometry(path_.legs[i], path_.legs[i + 1], options_), options_.strategy,
                                    options_.limits);
    }
    trim(stage.leg);
    stages_.push_back(std::move(stage));
  }

  // The part of the leg that the stretch before it left.
  void trim(Leg& leg) {
    if (taken_ == 0) return;
    leg.length -= taken_;
    leg.start = leg.end - leg.length * leg.direction;
    taken_ = 0;
  }

  // With so much of a leg in the stretch, mm.
  double gate_speed(const Leg& leg, double room) const {
    return std::min(leg.feed, room / (kLeastSteps * step_of_time(leg.tolerance, options_.limits)));
  }

  // Legs first to last; their outer ends may be left to straight stages.
  bool add_stretch(std::size_t first, std::size_t last) {
    const Leg &in = path_.legs[first], &out = path_.legs[last];
    const double far_before = first == 0 ? need(in, {}) : needs_[first - 1].after;
    const double far_after = last == needs_.size() ? need(out, {}) : needs_[last].before;
    const double from = in.length - share(in, needs_[first].before, far_before, first == 0 || !smooth(first - 1));
    const double left = out.length - share(out, needs_[last - 1].after, far_after, !smooth(last));
    const bool rests_first = from <= taken_, rests_last = left <= 0;
    const LegRange range{first, last, rests_first ? 0 : from, rests_last ? 0 : left};
    const EndSpeeds at_most{rests_first ? 0 : gate_speed(in, in.length - from),
                            rests_last ? 0 : gate_speed(out, out.length - left)};
    auto stretch = std::make_shared<Stretch>(path_, range, options_, at_most);
    if (stretch->failed()) {
      alone_.insert(first);
      return false;
    }
    if (!rests_first) {
      Stage stage{.leg = in,
                  .exit = Cornering(Passage{stretch->speeds().entry}),
                  .first_leg = first,
                  .last_leg = first,
                  .ends_on_joint = false};
      trim(stage.leg);
      stage.leg.end = in.start + from * in.direction;
      stage.leg.length -= in.length - from;
      stages_.push_back(std::move(stage));
    }
    Stage stage{.stretch = stretch, .first_leg = first, .last_leg = last, .ends_on_joint = rests_last};
    if (!rests_last) stage.exit = Cornering(Passage{stretch->speeds().exit});
    stages_.push_back(std::move(stage));
    taken_ = rests_last ? 0 : out.length - left;
    taken_whole_ = rests_last;
    return true;
  }

  const LegPath& path_;
  std::set<std::size_t>& alone_;
  const PlanOptions& options_;
  std::vector<Needs> needs_;  // of each joint but the last
  double taken_ = 0;          // of the next leg, by the stretch before it, mm
  bool taken_whole_ = false;
  std::vector<Stage> stages_;
};

}  // namespace

std::vector<Stage> stages_of(const LegPath& path, std::set<std::size_t>& alone, const PlanOptions& options) {
  return StageMaker(path, alone, options).run();
}

}  // namespace kcs::planning
