#include "server/planning/planner.h"

#include <algorithm>
#include <utility>

#include "server/planning/stopped.h"
#include "server/planning/validation.h"

namespace kcs::planning {
namespace {

const Toolpath& validated(const Toolpath& path, const PlanOptions& options) {
  validate(path, options);
  return path;
}

}  // namespace

Planner::Planner(const Toolpath& path, const PlanOptions& options)
    : path_(validated(path, options)),
      stop_(options.stop),
      plan_{.start = path.start, .path = motion::Path(path.start)},
      planner_(path, options, *this) {}

bool Planner::go_on() {
  throw_if_stopped(stop_);
  if (next_ < path_.segments.size()) {
    planner_.add(path_.segments[next_++]);
    return true;
  }
  plan_.summary = planner_.finish();
  plan_.trajectory.set_final_state(planner_.end_state());
  segments_planned_.store(path_.segments.size(), std::memory_order_relaxed);
  return false;
}

void Planner::take(const Segment& segment) { plan_.path.add(segment.end, segment.line); }

// What comes before the segments of a phase is planned; segments of no length, which phases do not count, are made up
// for at the end.
void Planner::take(const motion::Phase& phase) {
  plan_.trajectory.append(phase);
  if (const auto milestone = progress_.follow(phase)) plan_.milestones.push_back(*milestone);
  const std::size_t planned = phase.segments.first;
  segments_planned_.store(std::max(planned, segments_planned()), std::memory_order_relaxed);
}

void Planner::take(const Corner& corner) { plan_.corners.append(corner); }

void Planner::take(const MarkerAt& marker) { plan_.markers.push_back(marker); }
}  // namespace kcs::planning
