#include "server/motion/progress.h"

#include <algorithm>
#include <array>
#include <limits>

#include "server/motion/polynomial.h"

namespace kcs::motion {
namespace {

constexpr std::uint32_t kPhasesPerMilestone = 64;

// When a joint is passed is found this precisely, s: no two setpoints are so near.
constexpr double kInstant = 1e-6;

// A later part of the path along which the tool does not go forward must be nearer by this factor. It would seem to be
// reached too early where the path comes back, and the tool is between the way there and the way back.
constexpr double kAgainst = 16;

}  // namespace

Progress::Progress(const Path& path, const Place& from)
    : path_(&path), phases_(kPhasesPerMilestone), next_(from.segment), end_{0, from.way} {}

std::optional<Milestone> Progress::follow(const Phase& phase) {
  if (path_->segments() == 0) return {};
  std::optional<Milestone> milestone;
  // A phase that takes no time could not be found by its time.
  if (phases_ >= kPhasesPerMilestone && phase.end_time() > phase.start_time) {
    if (!runs_.empty()) *this = Progress(*path_, place(end_));
    milestone = {phase.start_time, {end_.way, next_}};
    phases_ = 0;
  }
  ++phases_;
  phase_ = phase;
  start_ = end_;
  gather(phase.segments.last);
  leave_behind(phase.segments.first);
  const std::uint32_t last_run = first_run_ + static_cast<std::uint32_t>(runs_.size()) - 1;
  end_ = nearest(phase.at(phase.duration), start_, {last_run, path_->way_to(next_)});
  return milestone;
}

Place Progress::at(double time) const {
  if (runs_.empty()) return {};
  Spot from = start_, to = end_;
  double early = 0, late = phase_.duration;
  while (from.run != to.run && late - early > kInstant) {
    const double middle = (early + late) / 2;
    const Spot spot = nearest(phase_.at(middle), from, to);
    if (time < middle) {
      to = spot;
      late = middle;
    } else {
      from = spot;
      early = middle;
    }
  }
  if (from.run != to.run) to = {from.run, path_->way_to(run(from.run).last + 1)};
  return place({from.run, std::min(std::max(from.way, farthest(from.run, early, time)), to.way)});
}

// The tool may go back along a run for a moment; the place does not.
double Progress::farthest(std::uint32_t index, double early, double time) const {
  const Run& followed = run(index);
  const Line& line = followed.line;
  const Vector& along = line.direction();
  const std::array<double, 4> speed{phase_.start.velocity.dot(along), phase_.start.acceleration.dot(along),
                                    phase_.jerk.dot(along) / 2, 0};
  const auto way_at = [&](double t) { return (phase_.at(t).position - line.from()).dot(along); };
  double way = std::max(way_at(early), way_at(time));
  for (const double turn : sign_changes(speed, time)) {
    if (turn > early) way = std::max(way, way_at(turn));
  }
  return path_->way_to(followed.first) + way;
}

// The segments up to this one.
void Progress::gather(std::uint32_t last) {
  for (; next_ <= last; ++next_) {
    const Vector &from = path_->start_of(next_), &to = path_->start_of(next_ + 1);
    if (!runs_.empty() && line_->extend(to)) {
      runs_.back().line = Line(line_->start(), to);
      runs_.back().last = next_;
    } else {
      line_.emplace(from, to);
      runs_.push_back({Line(from, to), next_, next_});
    }
  }
}

// The motion has left the segments before this one.
void Progress::leave_behind(std::uint32_t first) {
  while (run(start_.run).last < first) ++start_.run;
  start_.way = std::max(start_.way, path_->way_to(std::max(first, run(start_.run).first)));
  for (; first_run_ < start_.run; ++first_run_) runs_.pop_front();
}

Progress::Spot Progress::nearest(const State& state, const Spot& from, const Spot& to) const {
  const double equal = position_rounding(state.position);
  Spot best = from;
  double least = std::numeric_limits<double>::infinity();
  bool best_is_forward = false;
  for (std::uint32_t i = from.run; i <= to.run; ++i) {
    const auto& [line, first, last] = run(i);
    const double start = path_->way_to(first);
    const double begin = i == from.run ? from.way : start, end = i == to.run ? to.way : path_->way_to(last + 1);
    const double way = std::clamp(start + (state.position - line.from()).dot(line.direction()), begin, end);
    const bool forward = state.velocity.dot(line.direction()) >= 0;
    double distance = (line.from() + (way - start) * line.direction() - state.position).norm();
    if (!forward && i > from.run) distance *= kAgainst;
    if (distance < least - equal || (forward && !best_is_forward && distance < least + equal)) {
      best = {i, way};
      least = std::min(least, distance);
      best_is_forward = forward;
    }
  }
  return best;
}

Place Progress::place(const Spot& spot) const {
  std::uint32_t first = run(spot.run).first, last = run(spot.run).last;
  while (first < last) {
    const std::uint32_t middle = last - (last - first) / 2;
    if (path_->way_to(middle) <= spot.way) {
      first = middle;
    } else {
      last = middle - 1;
    }
  }
  return {spot.way, first};
}

}  // namespace kcs::motion
