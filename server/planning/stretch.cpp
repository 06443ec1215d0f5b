#include "server/planning/stretch.h"

#include <algorithm>
#include <utility>

#include "server/planning/first_draft.h"

namespace kcs::planning {
namespace {

// A draft goes on from what was found with this share of its speed at least, or else so many points later.
constexpr double kReached = 0.7;
constexpr std::size_t kFarther = 8;

template <class Values>
Values tail(const Values& values, std::size_t from) {
  return Values(values.begin() + static_cast<std::ptrdiff_t>(from), values.end());
}

}  // namespace

Stretch::Stretch(const LegPath& path, const LegRange& range, const PlanOptions& options, const EndSpeeds& at_most,
                 const BegunStretch* begun)
    : limits_(options.limits),
      hurried_(options.hurried),
      stop_(options.stop),
      begun_(begun),
      path_(path, range, options),
      step_(begun == nullptr ? step_of_time(path_.tolerance(), options.limits) : begun->settled.step) {
  search(at_most, false);
}

EndSpeeds Stretch::plan(const EndSpeeds& at_most) {
  if (failed() || (speeds_.entry <= at_most.entry && speeds_.exit <= at_most.exit)) return speeds_;
  const EndSpeeds slower{std::min(speeds_.entry, at_most.entry), std::min(speeds_.exit, at_most.exit)};
  // A motion that becomes a little slower than asked for makes its neighbours slower, and they it, on and on.
  if (slowed_) search(slower, true);
  if (!slowed_ || failed()) search(slower, false);
  slowed_ = true;
  return speeds_;
}

void Stretch::search(const EndSpeeds& at_most, bool exact) {
  TimeSpline settled;
  if (begun_ != nullptr) {
    settled = begun_->settled;
    for (Vector& point : settled.points) point -= path_.origin();
  }
  const MotionRange range{.from = begun_ == nullptr ? 0 : settled.ways.end()[-2],
                          .to = path_.length(),
                          .at_most = at_most,
                          .exact = exact,
                          .hurried = hurried_,
                          .before = begun_ == nullptr ? nullptr : &settled};
  SmoothMotion motion(path_, limits_, step_, stop_);
  if (!motion.search(range, draft(range))) {
    spline_ = {};
    speeds_ = {};
    return;
  }
  speeds_ = motion.speeds();
  weights_ = motion.weights();
  if (begun_ == nullptr) {
    spline_ = motion.spline();
    return;
  }
  spline_ = std::move(settled);
  const TimeSpline& found = motion.spline();
  spline_.points.insert(spline_.points.end(), found.points.begin() + 3, found.points.end());
  spline_.ways.insert(spline_.ways.end(), found.ways.begin() + 3, found.ways.end());
}

// What was found before, as far as it did not brake yet for its own end, and a slow motion after it; or farther, until
// the slow motion can be reached: what was found leads to rest.
MotionDraft Stretch::draft(const MotionRange& range) const {
  if (begun_ == nullptr) return first_draft(path_, limits_, range, step_);
  MotionDraft draft{begun_->ways, begun_->weights};
  const double enough = (draft.ways.front() + draft.ways.back()) / 2;
  std::size_t kept = 3;
  while (kept < draft.ways.size() && draft.ways[kept] < std::min(enough, range.to)) ++kept;
  const auto step_at_end = [&] { return draft.ways[kept - 1] - draft.ways[kept - 2]; };
  const auto slow_motion = [&] {
    const MotionRange rest{
        .from = draft.ways[kept - 1], .to = range.to, .at_most = {step_at_end() / step_, range.at_most.exit}};
    return first_draft(path_, limits_, rest, step_);
  };
  const auto can_reach = [&](const MotionDraft& next) {
    return !next.ways.empty() && next.ways[1] - next.ways[0] >= kReached * step_at_end();
  };
  MotionDraft fresh = slow_motion();
  while (!can_reach(fresh) && kept + kFarther <= draft.ways.size() && draft.ways[kept + kFarther - 1] < range.to) {
    kept += kFarther;
    fresh = slow_motion();
  }
  if (fresh.ways.empty()) return {};
  const auto join = [&](auto& values, const auto& more) {
    values.resize(kept);
    values.insert(values.end(), more.begin() + 2, more.end());
  };
  join(draft.ways, fresh.ways);
  join(draft.weights.place, fresh.weights.place);
  join(draft.weights.acceleration, fresh.weights.acceleration);
  join(draft.weights.jerk, fresh.weights.jerk);
  return draft;
}

motion::Phase Stretch::phase(std::size_t piece) const {
  const auto [first, last] = path_.legs_between(spline_.ways[piece], spline_.ways[piece + 3]);
  motion::Phase phase = spline_.phase(piece, path_.origin());
  phase.segments = {path_.legs()[first].segments.first, path_.legs()[last].segments.last};
  return phase;
}

BegunStretch Stretch::go_on(std::size_t points, std::size_t leg) const {
  const double start = path_.start_of(leg), middle = (path_.way(leg) + path_.way(leg + 1)) / 2;
  std::size_t from = points - 3;
  while (from > 0 && spline_.ways[from + 1] > middle) --from;
  const std::size_t settled = begun_ == nullptr ? 0 : begun_->settled.points.size() - 3;
  const std::size_t found = points - 3 - settled;
  const auto part = [&](const auto& values) {
    return std::vector(values.begin() + static_cast<std::ptrdiff_t>(from),
                       values.begin() + static_cast<std::ptrdiff_t>(points));
  };
  BegunStretch result{
      .settled = {spline_.step, part(spline_.points), part(spline_.ways)},
      .ways = tail(spline_.ways, points - 3),
      .weights = {tail(weights_.place, found), tail(weights_.acceleration, found), tail(weights_.jerk, found)}};
  for (Vector& point : result.settled.points) point += path_.origin();
  for (double& way : result.settled.ways) way -= start;
  for (double& way : result.ways) way -= start;
  return result;
}

}  // namespace kcs::planning
