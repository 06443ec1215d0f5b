#include "server/planning/planner.h"

#include <stdexcept>
#include <utility>

#include "server/motion/verifier.h"
#include "server/planning/corner_plan.h"
#include "server/planning/leg.h"
#include "server/planning/trajectory_builder.h"
#include "server/planning/validation.h"

namespace kcs::planning {
namespace {

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
    double* entry_lost = nullptr;  // of the corner before the leg, if there is one
    for (std::size_t i = 0; i < path_.legs.size(); ++i) {
      const CornerMotion exit = corners_.cornerings[i].at(corners_.speeds[i]);
      const LegTimes times = builder.leg(path_.legs[i], entry, exit);
      plan_.summary.time_at_feed += times.at_feed;
      if (entry_lost != nullptr) *entry_lost += times.entry_lost;
      entry_lost = take_joint(builder, i, exit, times.exit_lost);
      entry = exit;
    }
    plan_.start = path_.points.front();
    plan_.trajectory = builder.finish(path_.points.back());
  }

  // Moves through the joint at the end of leg i. Returns where to add what the next leg loses after it.
  double* take_joint(TrajectoryBuilder& builder, std::size_t i, const CornerMotion& motion, double exit_lost) {
    const Joint& joint = path_.joints[i];
    const bool last = i + 1 == path_.legs.size();
    if (last) {
      builder.dwell(path_.legs[i].end, joint.dwell, path_.legs[i].segments.last);
      return nullptr;
    }
    if (corners_.cornerings[i].is_passage()) return nullptr;
    const CornerGeometry corner = geometry(i);
    if (motion.speed > 0) {
      builder.corner(corner, corners_.cornerings[i], motion.speed);
    } else {
      builder.dwell(corner.in.end, joint.dwell, corner.in.segments.last);
    }
    plan_.corners.push_back(
        {.segment = corner.in.segments.last,
         .line = joint.line,
         .point = corner.in.end,
         .angle = corner.angle,
         .strategy = motion.speed > 0 ? corners_.cornerings[i].strategy() : CornerStrategy::kExactStop,
         .speed = motion.speed,
         .boundary_acceleration = motion.acceleration,
         .duration = motion.duration + joint.dwell,
         .dwell = joint.dwell,
         .corner_distance = motion.cut,
         .contour_error = motion.cut * corner.half_cosine,
         .time_lost = exit_lost + motion.duration});
    return &plan_.corners.back().time_lost;
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
    if (!found.passed()) throw std::logic_error("the plan failed its verification and is not served: " + found.fault);
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
  Plan plan_;
};

}  // namespace

Plan plan(const Toolpath& path, const PlanOptions& options) {
  validate(path, options);
  return Planner(path, options).run();
}

}  // namespace kcs::planning
