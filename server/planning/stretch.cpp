#include "server/planning/stretch.h"

#include <algorithm>
#include <cmath>

#include "server/motion/jlap.h"
#include "server/planning/first_draft.h"

namespace kcs::planning {
namespace {

// A window is this many steps of time long, at the feed. It looks ahead so many steps more, and as often as far as the
// tool needs to stop from the feed at which the look-ahead begins.
constexpr double kWindowSteps = 300, kAheadSteps = 100, kAheadStops = 3;
// A search that has taken this much work, in rounds times points, is given up: paths whose legs, limits and tolerances
// do not suit each other would take for ever.
constexpr double kWorkPerLeg = 10'000, kWorkAtLeast = 200'000;
// Where nothing was found, with windows of half the length, so often.
constexpr int kHalvings = 1;

}  // namespace

Stretch::Stretch(const LegPath& path, const LegRange& range, const PlanOptions& options, const EndSpeeds& at_most)
    : options_(options), path_(path, range, options), step_(step_of_time(path_.tolerance(), options.limits)) {
  search(at_most);
}

// From rest to a feed and along the axes' slowest direction, mm.
double Stretch::stopping_way(double feed) const {
  const auto& limits = options_.limits;
  const auto axes = static_cast<Eigen::Index>(limits.axes);
  return motion::ramp_to_peak(0, 0, feed, limits.acceleration.head(axes).minCoeff(), limits.jerk.head(axes).minCoeff())
      .distance;
}

// The way after which so many steps of time have passed at the feed, and this much at least, mm.
double Stretch::beyond(double from, double steps, double least) const {
  double time = 0, way = from;
  for (std::size_t leg = path_.leg_at(from); leg < path_.legs().size(); ++leg) {
    const double feed = path_.legs()[leg].feed, length = path_.way(leg + 1) - way;
    const double needed = std::max((steps * step_ - time) * feed, from + least - way);
    if (needed <= length) return way + needed;
    time += length / feed;
    way += length;
  }
  return way;
}

double Stretch::ahead(double from, double share) const {
  const double feed = path_.legs()[path_.leg_at(from)].feed;
  return beyond(from, share * kAheadSteps, share * kAheadStops * stopping_way(feed));
}

EndSpeeds Stretch::plan(const EndSpeeds& at_most) {
  if (failed() || (speeds_.entry <= at_most.entry && speeds_.exit <= at_most.exit)) return speeds_;
  search({std::min(speeds_.entry, at_most.entry), std::min(speeds_.exit, at_most.exit)});
  return speeds_;
}

void Stretch::search(const EndSpeeds& at_most) {
  spline_ = {};
  tail_ = {};
  work_left_ = kWorkAtLeast + kWorkPerLeg * static_cast<double>(path_.legs().size());
  double share = 1;  // of a whole window
  for (int halvings = 0;;) {
    const double from = spline_.points.empty() ? 0 : spline_.ways.end()[-2];
    const double until = beyond(from, share * kWindowSteps, 0);
    double to = ahead(until, share);
    const bool last = ahead(to, share) >= path_.length();
    if (last) to = path_.length();
    if (search_window(until, to, at_most, last)) {
      if (last) return;
      share = 1;
      halvings = 0;
      continue;
    }
    if (!tail_.points.empty() && work_left_ > 0) {
      follow_tail();
      continue;
    }
    if (halvings++ == kHalvings || work_left_ <= 0) {
      spline_ = {};
      speeds_ = {};
      return;
    }
    share /= 2;
  }
}

// The look-ahead was part of a whole motion: the tool can follow it for a while, in the end to rest, and from there on
// it is another search.
void Stretch::follow_tail() {
  constexpr std::size_t kPart = 3, kFewest = 8;
  const std::size_t ahead = tail_.points.size() - 3;
  const auto followed = static_cast<std::ptrdiff_t>(ahead / kPart < kFewest ? ahead : ahead / kPart);
  const auto settle = [&](auto& settled, auto& tail) {
    settled.insert(settled.end(), tail.begin() + 3, tail.begin() + 3 + followed);
    tail.erase(tail.begin(), tail.begin() + followed);
  };
  settle(spline_.points, tail_.points);
  settle(spline_.ways, tail_.ways);
  for (auto* weights : {&tail_weights_.place, &tail_weights_.acceleration, &tail_weights_.jerk}) {
    weights->erase(weights->begin(), weights->begin() + followed);
  }
  if (tail_.points.size() == 3) tail_ = {};
}

bool Stretch::search_window(double until, double to, const EndSpeeds& at_most, bool last) {
  const bool first = spline_.points.empty();
  const MotionRange range{.from = first ? 0 : spline_.ways.end()[-2],
                          .to = to,
                          .at_most = {first ? at_most.entry : 0, last ? at_most.exit : 0},
                          .before = first ? nullptr : &spline_};
  SmoothMotion motion(path_, options_.limits, first ? step_ : spline_.step);
  const bool found = motion.search(range, draft(range, motion.step()));
  work_left_ -= motion.work();
  if (!found) return false;
  if (first) speeds_.entry = motion.speeds().entry;
  if (last) speeds_.exit = motion.speeds().exit;
  commit(motion, last ? to : until, last);
  return true;
}

// What the window before found, as far as it did not brake yet for its own end, and a slow motion after it.
MotionDraft Stretch::draft(const MotionRange& range, double step) const {
  if (range.before == nullptr) return first_draft(path_, options_.limits, range, step);
  MotionDraft draft;
  std::size_t kept = 3;
  if (tail_.points.empty()) {
    draft.ways.assign(spline_.ways.end() - 3, spline_.ways.end());
    draft.weights = {std::vector(3, 1.0), std::vector(3, 1.0), std::vector(3, 1.0)};
  } else {
    draft.ways = tail_.ways;
    draft.weights = tail_weights_;
    const double enough = (draft.ways.front() + draft.ways.back()) / 2;
    while (kept < draft.ways.size() && draft.ways[kept] < enough) ++kept;
  }
  const double speed = (draft.ways[kept - 1] - draft.ways[kept - 2]) / step;
  const MotionRange rest{.from = draft.ways[kept - 1], .to = range.to, .at_most = {speed, range.at_most.exit}};
  const MotionDraft fresh = first_draft(path_, options_.limits, rest, step);
  if (fresh.ways.empty()) return {};
  const auto join = [&](std::vector<double>& values, const std::vector<double>& more) {
    values.resize(kept);
    values.insert(values.end(), more.begin() + 2, more.end());
  };
  join(draft.ways, fresh.ways);
  join(draft.weights.place, fresh.weights.place);
  join(draft.weights.acceleration, fresh.weights.acceleration);
  join(draft.weights.jerk, fresh.weights.jerk);
  return draft;
}

// Settles what lies before the look-ahead.
void Stretch::commit(const SmoothMotion& motion, double until, bool last) {
  const TimeSpline& found = motion.spline();
  std::size_t settled = found.points.size();
  if (!last) {
    settled = 4;
    while (settled < found.ways.size() && found.ways[settled] <= until) ++settled;
  }
  spline_.step = found.step;
  const std::ptrdiff_t known = spline_.points.empty() ? 0 : 3;
  const auto end = static_cast<std::ptrdiff_t>(settled);
  spline_.points.insert(spline_.points.end(), found.points.begin() + known, found.points.begin() + end);
  spline_.ways.insert(spline_.ways.end(), found.ways.begin() + known, found.ways.begin() + end);
  tail_ = {};
  if (last) return;
  tail_.step = found.step;
  tail_.points.assign(found.points.begin() + end - 3, found.points.end());
  tail_.ways.assign(found.ways.begin() + end - 3, found.ways.end());
  const auto after = [&](const std::vector<double>& values) {
    return std::vector(values.begin() + end - 3, values.end());
  };
  const FitWeights& weights = motion.weights();
  tail_weights_ = {after(weights.place), after(weights.acceleration), after(weights.jerk)};
}

motion::Phase Stretch::phase(std::size_t piece) const {
  const auto [first, last] = path_.legs_between(spline_.ways[piece], spline_.ways[piece + 3]);
  motion::Phase phase = spline_.phase(piece, path_.origin());
  phase.segments = {path_.legs()[first].segments.first, path_.legs()[last].segments.last};
  return phase;
}

}  // namespace kcs::planning
