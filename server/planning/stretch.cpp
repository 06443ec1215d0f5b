#include "server/planning/stretch.h"

#include <algorithm>
#include <utility>

#include "server/planning/density.h"
#include "server/planning/first_draft.h"
#include "server/planning/tightening.h"

namespace kcs::planning {
namespace {

// A draft goes on from what was found with this share of its speed at least, or else so many points later.
constexpr double kReached = 0.7;
constexpr std::size_t kFarther = 8;

// Slower ends, exactly as asked for, make a motion longer by this factor at most, unless its search went astray.
constexpr double kHardlySlower = 1.05;

// Stretches of fewer legs, one part of many, are not made faster: a tool is lifted, moved and lowered again and again.
constexpr std::size_t kFewestLegs = 4;

template <class Values>
Values tail(const Values& values, std::size_t from) {
  return Values(values.begin() + static_cast<std::ptrdiff_t>(from), values.end());
}

template <class Values>
Values head(const Values& values, std::size_t size) {
  return Values(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(size));
}

}  // namespace

Stretch::Stretch(const LegPath& path, const LegRange& range, const PlanOptions& options, const EndSpeeds& at_most,
                 const BegunStretch* begun)
    : limits_(options.limits),
      effort_(options.effort),
      stop_(options.stop),
      begun_(begun),
      path_(path, range, options),
      step_(long_step_of_time(path_.tolerance(), limits_)) {
  if (begun != nullptr) {
    last_ = begun->last;
    for (Vector& point : last_.points) point -= path_.origin();
    pieces_ = begun->settled;
    for (StretchPiece& piece : pieces_) piece.phase.start.position -= path_.origin();
  }
  // Whatever suited the stretch so far: what follows may be of another kind.
  MotionRange searched = motion_range(at_most, false);
  MotionDraft begin = draft(searched);
  const double step = step_of_time(path_.tolerance(), limits_);
  const auto points = static_cast<std::size_t>(static_cast<double>(begin.ways.size()) * begin.step / step);
  searched.dense = dense_ = is_dense(path_, searched.from, searched.to, points);
  const bool sparse = is_sparse(path_, searched.from, searched.to, points);
  long_steps_ = dense_ || (sparse && effort_ != Effort::kFull);
  if (!long_steps_) {
    step_ = step;
    if (begun == nullptr || begun->ways.empty()) begin = draft(searched);
  }
  take(search(searched, std::move(begin)));
  const bool misses_end = range.left == 0 && !failed() && speeds().exit < at_most.exit;
  if (!misses_end) return;
  // The path ends here, and somebody goes on from there: a little slower is of no use.
  searched = motion_range({speeds().entry, at_most.exit}, true);
  if (auto exact = search(searched, draft(searched))) take(std::move(exact));
}

MotionRange Stretch::motion_range(const EndSpeeds& at_most, bool exact) const {
  const bool begun = begun_ != nullptr;
  return {.from = begun ? last_.ways[1] : 0,
          .to = path_.length(),
          .at_most = at_most,
          .exact = exact,
          .effort = effort_,
          .dense = dense_,
          .before = begun ? &last_ : nullptr,
          .settled = pieces().first(first_piece())};
}

EndSpeeds Stretch::plan(const EndSpeeds& at_most) {
  const EndSpeeds now = speeds();
  if (failed() || (now.entry <= at_most.entry && now.exit <= at_most.exit)) return now;
  take(search_slower({std::min(now.entry, at_most.entry), std::min(now.exit, at_most.exit)}));
  slowed_ = true;
  return speeds();
}

// A motion that becomes a little slower than asked for makes its neighbours slower, and they it, on and on: the second
// time it gets what was asked for exactly. Where that is hard to reach, the slower ends cost less.
std::optional<Stretch::Found> Stretch::search_slower(const EndSpeeds& at_most) const {
  const auto search_with = [&](bool exact) {
    const MotionRange searched = motion_range(at_most, exact);
    return search(searched, draft(searched));
  };
  if (!slowed_) return search_with(false);
  auto exact = search_with(true);
  if (exact && exact->spline.duration() <= kHardlySlower * found_->spline.duration()) return exact;
  auto slower = search_with(false);
  const bool better = slower && (!exact || slower->spline.duration() < exact->spline.duration());
  return better ? slower : exact;
}

std::optional<Stretch::Found> Stretch::search(const MotionRange& range, MotionDraft draft) const {
  SmoothMotion motion(path_, limits_, step_, stop_);
  if (!motion.search(range, std::move(draft))) return {};
  return Found{motion.spline(), motion.weights(), motion.speeds()};
}

void Stretch::take(std::optional<Found> found) {
  found_ = std::move(found);
  if (failed()) return;
  pieces_.resize(first_piece());
  append_pieces(found_->spline, pieces_);
  find_legs(path_, std::span(pieces_).subspan(first_piece()));
}

// There is little to gain where longer steps do, and where corners are few.
void Stretch::tighten(std::size_t pieces) {
  const std::size_t first = first_piece(), found = pieces - first;
  const std::size_t legs = path_.leg_at(pieces_[pieces - 1].to) - path_.leg_at(pieces_[first].from) + 1;
  const bool hardly = long_steps_ || legs < kFewestLegs;
  if (tightened_ || effort_ == Effort::kLeast || (effort_ == Effort::kUsual && hardly)) return;
  tightened_ = true;
  TimeSpline spline{found_->spline.step, head(found_->spline.points, found + 3), head(found_->spline.ways, found + 3)};
  spline = Tightening(path_, limits_, stop_).run(spline, this->pieces().first(first));
  std::vector<StretchPiece> after = tail(pieces_, pieces);
  const double before = pieces_[pieces - 1].phase.end_time();
  pieces_.resize(first);
  append_pieces(spline, pieces_);
  find_legs(path_, std::span(pieces_).subspan(first));
  const double earlier = before - pieces_.back().phase.end_time();
  for (StretchPiece& piece : after) piece.phase.start_time -= earlier;
  pieces_.insert(pieces_.end(), after.begin(), after.end());
}

// What was found before, as far as it did not brake yet for its own end, and a slow motion after it; or farther, until
// the slow motion can be reached: what was found leads to rest.
MotionDraft Stretch::draft(const MotionRange& range) const {
  if (begun_ == nullptr || begun_->ways.empty()) return first_draft(path_, limits_, range, step_);
  MotionDraft draft{begun_->last.step, begun_->ways, begun_->weights};
  const double enough = (draft.ways.front() + draft.ways.back()) / 2;
  std::size_t kept = 3;
  while (kept < draft.ways.size() && draft.ways[kept] < std::min(enough, range.to)) ++kept;
  const auto step_at_end = [&] { return draft.ways[kept - 1] - draft.ways[kept - 2]; };
  const auto slow_motion = [&] {
    const MotionRange rest{
        .from = draft.ways[kept - 1], .to = range.to, .at_most = {step_at_end() / draft.step, range.at_most.exit}};
    return first_draft(path_, limits_, rest, draft.step);
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
  motion::Phase phase = pieces_[piece].phase;
  phase.start.position += path_.origin();
  phase.segments = {path_.legs()[pieces_[piece].first_leg].segments.first,
                    path_.legs()[pieces_[piece].last_leg].segments.last};
  return phase;
}

BegunStretch Stretch::go_on(std::size_t pieces, std::size_t leg) const {
  const TimeSpline& spline = found_->spline;
  const FitWeights& weights = found_->weights;
  const double start = path_.start_of(leg), middle = (path_.way(leg) + path_.way(leg + 1)) / 2;
  std::size_t from = pieces - 1;
  while (from > 0 && pieces_[from].from > middle) --from;
  const std::size_t found = pieces - first_piece();
  const auto next_three = [&](const auto& values) {
    return std::vector(values.begin() + static_cast<std::ptrdiff_t>(found),
                       values.begin() + static_cast<std::ptrdiff_t>(found + 3));
  };
  BegunStretch result{
      .settled = {pieces_.begin() + static_cast<std::ptrdiff_t>(from),
                  pieces_.begin() + static_cast<std::ptrdiff_t>(pieces)},
      .last = {spline.step, next_three(spline.points), next_three(spline.ways)},
      .ways = tail(spline.ways, found),
      .weights = {tail(weights.place, found), tail(weights.acceleration, found), tail(weights.jerk, found)}};
  const double time = result.settled.front().phase.start_time;
  for (StretchPiece& piece : result.settled) {
    piece.phase.start_time -= time;
    piece.phase.start.position += path_.origin();
    piece.from -= start;
    piece.to -= start;
    piece.first_leg -= std::min(piece.first_leg, leg);
    piece.last_leg -= std::min(piece.last_leg, leg);
  }
  for (Vector& point : result.last.points) point += path_.origin();
  for (double& way : result.last.ways) way -= start;
  for (double& way : result.ways) way -= start;
  return result;
}

}  // namespace kcs::planning
