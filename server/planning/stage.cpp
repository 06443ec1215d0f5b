#include "server/planning/stage.h"

#include <algorithm>
#include <utility>

#include "server/planning/leg_profile.h"
#include "server/planning/sharp_turns.h"
#include "server/planning/stopped.h"

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

// Of the lines before its first bend and after its last one, so many steps of time belong to a stretch at least. Where
// a line becomes an arc, the acceleration across the path cannot change for longer without leaving the tolerance (for a
// time t it takes the tool jerk·t³/24 aside, a tolerance on either side of the path): with less room it has to change
// by less, and the tool to be slower.
constexpr double kRoomSteps = 16;
// The same where nothing slows the tool down. Where a leg has no room for that, a stretch begins or ends so slowly that
// it takes so many steps.
constexpr double kLeastSteps = 3;

// The same as kMostSteps at a sharp corner: the tool is slow there, and there is less to win.
constexpr double kMostStepsSharp = 50;

class StageMaker {
 public:
  StageMaker(const LegPath& path, const Entry& entry, double end_speed, std::set<std::size_t>& alone,
             const PlanOptions& options)
      : path_(path), entry_(entry), end_speed_(end_speed), alone_(alone), options_(options), taken_(entry.taken) {
    needs_.reserve(path.legs.size());
    stages_.reserve(path.legs.size());
    for (std::size_t i = 0; i + 1 < path.legs.size(); ++i) {
      throw_if_stopped(options.stop);
      if (options.strategy == CornerStrategy::kAuto) {
        add_needs(i);
      } else {
        needs_.push_back({});
      }
    }
    for (std::size_t i = 0; i < needs_.size(); ++i) {
      needs_[i].after = std::max(needs_[i].after, needed_after(i) - path.legs[i].length);
    }
    for (std::size_t i = needs_.size(); i-- > 1;) {
      needs_[i - 1].before = std::max(needs_[i - 1].before, needs_[i].before - path.legs[i].length);
    }
  }

  Stages run() {
    std::size_t leg = entry_.begun ? go_on() : 0;
    while (leg < path_.legs.size()) {
      const std::size_t last = last_coupled(leg);
      if (last == leg || alone_.contains(leg) || !add_stretch(leg, last + 1)) {
        do {
          add_leg(leg);
        } while (leg++ < last);
      } else {
        leg = after_stretch(last + 1);
      }
    }
    return {std::move(stages_), std::move(needs_)};
  }

 private:
  // Returns the leg after the stretch that has begun.
  std::size_t go_on() {
    const std::size_t last = last_coupled(entry_.begun->joint) + 1;
    const ExitShare exit = exit_share(last);
    auto stretch = std::make_shared<Stretch>(path_, LegRange{0, last, 0, exit.left}, options_,
                                             EndSpeeds{0, exit.at_most}, &*entry_.begun);
    add_stretch_stage(std::move(stretch), 0, last, exit);
    return after_stretch(last);
  }

  std::size_t last_coupled(std::size_t joint) const {
    while (coupled(joint)) ++joint;
    return joint;
  }

  std::size_t after_stretch(std::size_t last) const { return last + (taken_whole_ ? 1 : 0); }

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
    const bool free = is_free(in, out, motion.speed);
    const double steps = free ? kLeastSteps : kRoomSteps;
    const double room = steps * (tolerance > 0 ? step_of_time(tolerance, options_.limits) : 0);
    needs_.push_back({std::max(need(in, motion), room * in.feed), std::max(need(out, motion), room * out.feed),
                      motion.speed > 0, free});
  }

  // speed: that of the corner alone. Where a line becomes an arc in short chords, the first corner turns by half as
  // much as the next ones; and in the arc, v² / radius is an acceleration.
  bool is_free(const Leg& in, const Leg& out, double speed) const {
    const auto axes = static_cast<Eigen::Index>(options_.limits.axes);
    const double feed = std::min(in.feed, out.feed), turn = 2 * (out.direction - in.direction).norm();
    const double asked = feed * feed * turn / std::min(in.length, out.length);
    return speed >= feed && asked <= options_.limits.acceleration.head(axes).minCoeff();
  }

  bool smooth(std::size_t i) const { return i < needs_.size() && needs_[i].smooth; }

  // What is needed of a leg for the corner before it, and for the one after it.
  double needed_after(std::size_t leg) const {
    if (leg > 0) return needs_[leg - 1].after;
    return entry_.rests ? need(path_.legs[0], {}) : entry_.need;
  }
  double needed_before(std::size_t leg) const {
    return leg < needs_.size() ? needs_[leg].before : need(path_.legs[leg], {.speed = end_speed_});
  }
  bool rests_before(std::size_t leg) const { return leg == 0 ? entry_.rests : !smooth(leg - 1); }
  bool ends_path(std::size_t leg) const { return leg == needs_.size(); }

  // The corners at the ends of legs i and i + 1 are taken by one motion.
  bool coupled(std::size_t i) const {
    if (!smooth(i) || !smooth(i + 1)) return false;
    const Leg &in = path_.legs[i], &leg = path_.legs[i + 1], &out = path_.legs[i + 2];
    const bool sharp = is_sharp(in.direction, leg.direction) || is_sharp(leg.direction, out.direction);
    const double most = sharp ? kMostStepsSharp : kMostSteps;
    if (leg.length > most * leg.feed * step_of_time(leg.tolerance, options_.limits)) return false;
    const bool near = std::max(needs_[i].after + needs_[i + 1].before, need(leg, {})) > leg.length;
    return near || !(needs_[i].free && needs_[i + 1].free);
  }

  // What a stretch takes of a leg, mm, at whose near end it has a corner that needs `near`, and at whose far end there
  // is one that needs `far`. All of it if there is no more room and nothing else wants it: the tool rests there, or the
  // path begins or ends.
  static double share(const Leg& leg, double near, double far, bool all) {
    const double slack = leg.length - near - far;
    if (slack > 0) return near + std::min(kShareOfSlack * slack, kMoreRoom * near);
    return all ? leg.length : kShareOfTight * leg.length * near / (near + far);
  }

  void add_leg(std::size_t i) {
    throw_if_stopped(options_.stop);
    Stage stage{.leg = path_.legs[i], .first_leg = i, .last_leg = i};
    if (ends_path(i)) {
      if (end_speed_ > 0) stage.exit = Cornering(Passage{end_speed_});
    } else if (!path_.joints[i].stop) {
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

  // How a stretch that ends on a leg ends.
  struct ExitShare {
    double left = 0;     // of the leg, mm
    double at_most = 0;  // speed, mm/s
  };

  ExitShare exit_share(std::size_t last) const {
    const Leg& out = path_.legs[last];
    const bool all = ends_path(last) || !smooth(last);
    const double left = out.length - share(out, needed_after(last), needed_before(last), all);
    if (left <= 0) return {0, ends_path(last) ? end_speed_ : 0};
    return {left, gate_speed(out, out.length - left)};
  }

  // How a stretch begins.
  struct EntryShare {
    double left = 0;     // of its first leg, mm; 0: it begins with the leg, or where the tool is
    double at_most = 0;  // speed, mm/s
    const BegunStretch* in_motion = nullptr;
  };

  EntryShare entry_share(std::size_t first) const {
    const Leg& in = path_.legs[first];
    const bool in_motion = first == 0 && entry_.in_motion, all = in_motion || rests_before(first);
    const double left = in.length - share(in, needs_[first].before, needed_after(first), all);
    if (left > taken_) return {left, gate_speed(in, in.length - left)};
    return in_motion ? EntryShare{0, entry_.motion.speed, &*entry_.in_motion} : EntryShare{};
  }

  // Legs first to last; their outer ends may be left to straight stages.
  bool add_stretch(std::size_t first, std::size_t last) {
    const Leg& in = path_.legs[first];
    const EntryShare entry = entry_share(first);
    const ExitShare exit = exit_share(last);
    const LegRange range{first, last, entry.left, exit.left};
    auto stretch =
        std::make_shared<Stretch>(path_, range, options_, EndSpeeds{entry.at_most, exit.at_most}, entry.in_motion);
    if (stretch->failed()) {
      alone_.insert(first);
      return false;
    }
    if (entry.left > 0) {
      Stage stage{.leg = in,
                  .exit = Cornering(Passage{stretch->speeds().entry}),
                  .first_leg = first,
                  .last_leg = first,
                  .ends_on_joint = false};
      trim(stage.leg);
      stage.leg.end = in.start + entry.left * in.direction;
      stage.leg.length -= in.length - entry.left;
      stages_.push_back(std::move(stage));
    }
    add_stretch_stage(std::move(stretch), first, last, exit);
    return true;
  }

  void add_stretch_stage(std::shared_ptr<Stretch> stretch, std::size_t first, std::size_t last, const ExitShare& exit) {
    taken_whole_ = exit.left == 0;
    taken_ = taken_whole_ ? 0 : path_.legs[last].length - exit.left;
    Stage stage{.stretch = std::move(stretch), .first_leg = first, .last_leg = last, .ends_on_joint = taken_whole_};
    if (exit.at_most > 0) stage.exit = Cornering(Passage{stage.stretch->speeds().exit});
    stages_.push_back(std::move(stage));
  }

  const LegPath& path_;
  const Entry& entry_;
  double end_speed_;
  std::set<std::size_t>& alone_;
  const PlanOptions& options_;
  std::vector<CornerNeeds> needs_;
  double taken_;  // of the next leg, by the stretch before it, mm
  bool taken_whole_ = false;
  std::vector<Stage> stages_;
};

}  // namespace

Stages stages_of(const LegPath& path, const Entry& entry, double end_speed, std::set<std::size_t>& alone,
                 const PlanOptions& options) {
  return StageMaker(path, entry, end_speed, alone, options).run();
}

}  // namespace kcs::planning
