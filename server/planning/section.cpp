#include "server/planning/section.h"

#include <algorithm>
#include <utility>

#include "server/planning/stopped.h"
#include "server/planning/stretch_corners.h"

namespace kcs::planning {
namespace {

// What another plan takes over of a stretch: at least so many pieces. A shorter rest is left no freedom.
constexpr std::size_t kFewestLeft = 60;

// A section is followed by this share at a time, a stretch by so many pieces at least, or else to its end.
constexpr std::size_t kFollowed = 3, kFewest = 8;

}  // namespace

std::unique_ptr<Section> Section::plan(LegPath path, Entry entry, double end_speed, bool alone,
                                       const PlanOptions& options) {
  std::unique_ptr<Section> section(new Section(std::move(path), std::move(entry), options));
  const auto make = alone ? compare_corners : plan_corners;
  auto corners = make(section->path_, section->entry_, end_speed, options);
  if (!corners) return nullptr;
  section->corners_ = std::move(*corners);
  return section;
}

void Section::tighten(const Cut& to) {
  for (std::size_t i = 0; i < corners_.stages.size() && i <= to.stage; ++i) {
    const auto& stretch = corners_.stages[i].stretch;
    if (!stretch || (i == to.stage && to.pieces == 0)) continue;
    stretch->tighten(i == to.stage ? to.pieces : stretch->pieces().size());
  }
}

void Section::build(double time) {
  MotionBuilder builder(time);
  CornerMotion entry = entry_.motion;
  for (std::size_t i = 0; i < corners_.stages.size(); ++i) {
    throw_if_stopped(options_.stop);
    const Stage& stage = corners_.stages[i];
    const CornerMotion exit = motion_after(i);
    first_phases_.push_back(builder.phases().size());
    leg_times_.emplace_back();
    if (stage.stretch) {
      builder.stretch(*stage.stretch);
    } else {
      leg_times_.back() = builder.leg(stage.leg, entry, exit);
    }
    if (stage.ends_on_joint) build_joint(builder, i);
    entry = exit;
  }
  phases_ = builder.take();
}

// Moves through the joint at the end of a stage.
void Section::build_joint(MotionBuilder& builder, std::size_t stage) const {
  const std::size_t leg = corners_.stages[stage].last_leg;
  const Cornering& cornering = corners_.stages[stage].exit;
  const double speed = corners_.speeds[stage];
  if (speed == 0) {
    builder.dwell(path_.legs[leg].end, path_.joints[leg].dwell, path_.legs[leg].segments.last);
  } else if (leg + 1 < path_.legs.size() && !cornering.is_passage()) {
    builder.corner(geometry(leg), cornering, speed);
  }
}

std::size_t Section::phase_at(const Cut& cut) const {
  if (cut == end()) return phases_.size();
  const std::size_t first = first_phases_[cut.stage];
  return cut.pieces == 0 ? first : first + cut.pieces - corners_.stages[cut.stage].stretch->first_piece();
}

std::span<const motion::Phase> Section::phases(const Cut& from, const Cut& to) const {
  return std::span(phases_).subspan(phase_at(from), phase_at(to) - phase_at(from));
}

double Section::record(const Cut& from, const Cut& to, CornerLog& log) const {
  double at_feed = 0;
  for (std::size_t i = from.stage; i < to.stage || (i == to.stage && to.pieces > 0); ++i) {
    throw_if_stopped(options_.stop);
    const Stage& stage = corners_.stages[i];
    if (stage.stretch) {
      const std::size_t first = i == from.stage ? from.pieces : 0;
      at_feed += record_stretch(i, first, i == to.stage ? to.pieces : stage.stretch->pieces().size(), log);
      continue;
    }
    const LegTimes& times = leg_times_[i];
    at_feed += times.at_feed;
    log.lose_after(times.entry_lost);
    if (stage.ends_on_joint) {
      record_joint(i, times.exit_lost, log);
    } else {
      log.lose_before(times.exit_lost);  // the corners of the stretch that follows are not known yet
    }
  }
  return at_feed;
}

double Section::record_stretch(std::size_t stage, std::size_t from, std::size_t to, CornerLog& log) const {
  const Stage& it = corners_.stages[stage];
  std::vector<Corner> corners;
  const StretchTimes times = add_corners(*it.stretch, from, to, path_.joints, it.first_leg, options_, corners);
  const bool from_leg = stage > 0 && !corners_.stages[stage - 1].ends_on_joint;
  if (from_leg) {
    log.lose_before(times.entry_lost);
  } else {
    log.lose_after(times.entry_lost);
  }
  for (const Corner& corner : corners) log.add(corner);
  if (to < it.stretch->pieces().size()) return times.at_feed;
  if (it.ends_on_joint) {
    record_joint(stage, times.exit_lost, log);
  } else {
    log.lose_after(times.exit_lost);
  }
  return times.at_feed;
}

void Section::record_joint(std::size_t stage, double exit_lost, CornerLog& log) const {
  const std::size_t leg = corners_.stages[stage].last_leg;
  const Cornering& cornering = corners_.stages[stage].exit;
  if (leg + 1 == path_.legs.size() || cornering.is_passage()) return;
  const CornerGeometry corner = geometry(leg);
  const CornerMotion motion = motion_after(stage);
  const double dwell = path_.joints[leg].dwell;
  log.lose_before(exit_lost + motion.duration);
  log.add({.segment = corner.in.segments.last,
           .line = path_.joints[leg].line,
           .point = corner.in.end,
           .angle = corner.angle(),
           .strategy = motion.speed > 0 ? cornering.strategy() : CornerStrategy::kExactStop,
           .speed = motion.speed,
           .boundary_acceleration = motion.acceleration,
           .duration = motion.duration + dwell,
           .dwell = dwell,
           .corner_distance = motion.cut,
           .contour_error = motion.cut * corner.half_cosine});
}

Section::Cut Section::cut_at(std::size_t leg) const {
  Cut best;
  for (std::size_t i = 0; i < corners_.stages.size(); ++i) {
    const Stage& stage = corners_.stages[i];
    if (stage.last_leg <= leg) {
      if (ends_well(stage)) best = {i + 1, 0};
    } else {
      if (stage.stretch && stage.first_leg <= leg) return cut_inside(i, leg).value_or(best);
      break;
    }
  }
  return best;
}

// Inside a stretch, where it has not come to its last leg.
std::optional<Section::Cut> Section::cut_inside(std::size_t stage, std::size_t leg) const {
  const Stretch& stretch = *corners_.stages[stage].stretch;
  const auto pieces = stretch.pieces();
  const std::size_t first = stretch.first_piece();
  if (pieces.size() <= first + kFewestLeft) return {};
  const auto found = pieces.subspan(first, pieces.size() - kFewestLeft - first);
  const double limit = stretch.path().way(leg - corners_.stages[stage].first_leg + 1);
  // What goes on from there begins with the points of the next piece: that one must not leave the leg either.
  const auto beyond = std::ranges::upper_bound(found, limit, {}, &StretchPiece::to) - found.begin();
  if (beyond < 2) return {};
  return Cut{stage, first + static_cast<std::size_t>(beyond) - 1};
}

Section::Cut Section::cut_after(const Cut& cut) const {
  const std::size_t stages = corners_.stages.size();
  std::size_t last = cut.stage;  // of those that are followed
  if (cut.pieces == 0) {
    last += (stages - cut.stage) / kFollowed;
    while (last < stages && !ends_well(corners_.stages[last])) ++last;
    if (last >= stages) return end();
  }
  // A stretch that is not the last one was not planned to a rest that nobody asked for: it is followed to its end.
  if (!corners_.stages[last].stretch || last + 1 < stages) return {last + 1, 0};
  const Stretch& stretch = *corners_.stages[last].stretch;
  const auto pieces = stretch.pieces();
  const std::size_t from = cut.pieces > 0 ? cut.pieces : stretch.first_piece();
  const std::size_t followed = (pieces.size() - from) / kFollowed, to = from + followed;
  if (followed < kFewest) return {last + 1, 0};
  const bool on_last_leg = stretch.path().leg_at(pieces[to].to) + 1 == stretch.path().legs().size();
  return on_last_leg ? Cut{last + 1, 0} : Cut{last, to};
}

Section::Rest Section::rest_from(const Cut& cut) const {
  if (cut == begin()) return {0, entry_};
  if (cut.pieces > 0) return rest_of_stretch(cut);
  const std::size_t before = cut.stage - 1;
  const Stage& stage = corners_.stages[before];
  if (stage.ends_on_joint && stage.last_leg + 1 == path_.legs.size()) return {path_.legs.size(), {}};
  Rest rest{.first_leg = stage.last_leg, .entry = {.motion = motion_after(before), .rests = false}};
  if (stage.ends_on_joint) {
    ++rest.first_leg;
    rest.entry.need = corners_.needs[stage.last_leg].after;
    rest.entry.rests = !corners_.needs[stage.last_leg].smooth;
  } else {
    const StretchPath& path = stage.stretch->path();
    rest.entry.taken = path.length() - path.start_of(path.legs().size() - 1);
    rest.entry.need = corners_.needs[stage.last_leg - 1].after;
  }
  return rest;
}

Section::Rest Section::rest_of_stretch(const Cut& cut) const {
  const Stage& stage = corners_.stages[cut.stage];
  const Stretch& stretch = *stage.stretch;
  const std::size_t first = first_unreported(stretch, cut.pieces), leg = stage.first_leg + first;
  Rest rest{.first_leg = leg,
            .entry = {.need = entry_.need, .rests = false, .begun = stretch.go_on(cut.pieces, first)}};
  if (leg > 0) rest.entry.need = corners_.needs[leg - 1].after;
  rest.entry.begun->joint = stretch.path().leg_at(stretch.pieces()[cut.pieces].to) - first;
  return rest;
}

}  // namespace kcs::planning
