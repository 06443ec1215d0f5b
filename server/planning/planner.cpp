#include "server/planning/planner.h"

#include <stdexcept>
#include <utility>

#include "server/motion/verifier.h"
#include "server/planning/corner_plan.h"
#include "server/planning/leg.h"
#include "server/planning/stretch_corners.h"
#include "server/planning/trajectory_builder.h"
#include "server/planning/validation.h"

namespace kcs::planning {
namespace {

// By the verifier.
class Refused : public std::logic_error {
 public:
  using std::logic_error::logic_error;
};

class Planner {
 public:
  Planner(const Toolpath& path, const PlanOptions& options) : options_(options), path_(legs_of(path, options.limits)) {}

  Plan run() {
    build();
    verify();
    sum_up();
    return std::move(plan_);
  }

 private:
  CornerGeometry geometry(std::size_t joint) const {
    return corner_geometry(path_.legs[joint], path_.legs[joint + 1], options_);
  }

  void build() {
    corners_ = plan_corners(path_, options_);
    TrajectoryBuilder builder;
    builder.dwell(path_.points.front(), path_.initial_dwell, 0);
    CornerMotion entry;
    for (std::size_t i = 0; i < corners_.stages.size(); ++i) {
      const Stage& stage = corners_.stages[i];
      const CornerMotion exit = stage.exit.at(corners_.speeds[i]);
      const std::size_t known = plan_.corners.size();
      const LegTimes times = travel(builder, stage, entry, exit);
      plan_.summary.time_at_feed += times.at_feed;
      // What was lost since the corner before counts there; what a stretch lost that begins in the middle of a leg, at
      // its own first corner.
      const bool from_leg = stage.stretch && i > 0 && !corners_.stages[i - 1].ends_on_joint;
      const std::size_t before = from_leg ? known + 1 : known;
      if (before > 0) lose(plan_.corners[before - 1], times.entry_lost);
      if (stage.ends_on_joint) {
        take_joint(builder, stage.last_leg, stage.exit, exit, times.exit_lost);
      } else if (stage.stretch) {
        lose(plan_.corners.back(), times.exit_lost);
      } else {
        carried_ = times.exit_lost;
      }
      entry = exit;
    }
    plan_.start = path_.points.front();
    plan_.trajectory = builder.finish(path_.points.back());
  }

  LegTimes travel(TrajectoryBuilder& builder, const Stage& stage, const CornerMotion& entry, const CornerMotion& exit) {
    if (!stage.stretch) return builder.leg(stage.leg, entry, exit);
    builder.stretch(*stage.stretch);
    const StretchTimes times = add_corners(*stage.stretch, path_.joints, stage.first_leg, options_, plan_.corners);
    return {times.entry_lost, times.exit_lost, times.at_feed};
  }

  void lose(Corner& corner, double time) {
    corner.time_lost += time + carried_;
    carried_ = 0;
  }

  // Moves through the joint at the end of leg i.
  void take_joint(TrajectoryBuilder& builder, std::size_t i, const Cornering& cornering, const CornerMotion& motion,
                  double exit_lost) {
    const Joint& joint = path_.joints[i];
    const bool last = i + 1 == path_.legs.size();
    if (last) {
      builder.dwell(path_.legs[i].end, joint.dwell, path_.legs[i].segments.last);
      return;
    }
    if (cornering.is_passage()) return;
    const CornerGeometry corner = geometry(i);
    if (motion.speed > 0) {
      builder.corner(corner, cornering, motion.speed);
    } else {
      builder.dwell(corner.in.end, joint.dwell, corner.in.segments.last);
    }
    plan_.corners.push_back({.segment = corner.in.segments.last,
                             .line = joint.line,
                             .point = corner.in.end,
                             .angle = corner.angle,
                             .strategy = motion.speed > 0 ? cornering.strategy() : CornerStrategy::kExactStop,
                             .speed = motion.speed,
                             .boundary_acceleration = motion.acceleration,
                             .duration = motion.duration + joint.dwell,
                             .dwell = joint.dwell,
                             .corner_distance = motion.cut,
                             .contour_error = motion.cut * corner.half_cosine,
                             .time_lost = exit_lost + motion.duration});
  }

  void verify() {
    // A path without motion is one segment of no length to the verifier.
    if (path_.legs.empty()) {
      path_.points.push_back(path_.points.front());
      path_.feeds.push_back(0);
      path_.tolerances.push_back(0);
      path_.rests.push_back(-1);
    }
    std::vector<double> reaches(path_.feeds.size(), 0);
    for (std::size_t i = 0; i + 1 < path_.legs.size(); ++i) {
      if (!path_.joints[i].stop) reaches[path_.legs[i].segments.last] = geometry(i).reach;
    }
    const auto found = motion::verify(
        plan_.trajectory, {path_.points, path_.feeds, path_.tolerances, reaches, path_.rests}, options_.limits);
    if (!found.passed()) throw Refused("the plan failed its verification and is not served: " + found.fault);
    plan_.summary.max_velocity = found.max_velocity;
    plan_.summary.max_acceleration = found.max_acceleration;
    plan_.summary.max_jerk = found.max_jerk;
    plan_.summary.max_feed = found.max_feed;
    plan_.summary.max_contour_error = found.max_contour_error;
  }

  void sum_up() {
    Summary& summary = plan_.summary;
    summary.cycle_time = plan_.trajectory.duration();
    summary.dwell_time = path_.initial_dwell;
    for (const Joint& joint : path_.joints) summary.dwell_time += joint.dwell;
    for (const Leg& leg : path_.legs) {
      summary.path_length += leg.length;
      summary.segments = leg.segments.last + 1;
    }
    for (const Corner& corner : plan_.corners) {
      summary.time_lost_at_corners += corner.time_lost;
      switch (corner.strategy) {
        case CornerStrategy::kInterrupted:
          ++summary.interrupted;
          break;
        case CornerStrategy::kUninterrupted:
          ++summary.uninterrupted;
          break;
        case CornerStrategy::kBlended:
          ++summary.blended;
          break;
        case CornerStrategy::kOverlapping:
          ++summary.overlapping;
          break;
        case CornerStrategy::kExactStop:
          ++summary.exact_stops;
          break;
        case CornerStrategy::kAuto:
          throw std::logic_error("a corner without a strategy");
      }
    }
  }

  PlanOptions options_;
  LegPath path_;
  CornerPlan corners_;
  double carried_ = 0;  // s, lost by a leg before a stretch whose corners are not known yet
  Plan plan_;
};

}  // namespace

Plan plan(const Toolpath& path, const PlanOptions& options) {
  validate(path, options);
  if (options.strategy != CornerStrategy::kAuto) return Planner(path, options).run();
  try {
    return Planner(path, options).run();
  } catch (const Refused&) {
    // Smooth motions through many corners are found by trying; corners one by one are inside the limits by themselves.
    PlanOptions one_by_one = options;
    one_by_one.strategy = CornerStrategy::kBlended;
    return Planner(path, one_by_one).run();
  }
}

}  // namespace kcs::planning
