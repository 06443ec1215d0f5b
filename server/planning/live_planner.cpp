#include "server/planning/live_planner.h"

#include <spdlog/fmt/fmt.h>

#include <array>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "server/planning/invalid_input.h"
#include "server/planning/leg_profile.h"
#include "server/planning/stopped.h"
#include "server/planning/validation.h"

namespace kcs::planning {
namespace {

// Where no motion is found as far as the horizon, nearer ones are tried: these shares of it.
constexpr std::array<double, 3> kNearer{0.5, 0.25, 0.125};
// Less is settled at first, for the machine waits for it.
constexpr double kFirst = 0.5;

// The first three points of a spline that begins in this state along a leg.
TimeSpline spline_from(const Leg& leg, const motion::LinearState& state) {
  constexpr double kStep = 1e-3;  // any will do
  const double move = state.velocity * kStep, bend = state.acceleration * kStep * kStep;
  const auto point = [&](double along) -> Vector { return leg.start + (state.position + along) * leg.direction; };
  return {.step = kStep,
          .points = {point(bend / 3 - move), point(-bend / 6), point(bend / 3 + move)},
          .ways = {state.position - move, state.position, state.position + move}};
}

InvalidInput invalid(const char* field, std::string description) {
  return InvalidInput({{field, std::move(description)}});
}

}  // namespace

LivePlanner::LivePlanner(const PathEnds& ends, const PlanOptions& options, PlanReceiver& receiver)
    : ends_(ends),
      options_(options),
      receiver_(receiver),
      legs_(ends.start, options.limits),
      horizon_(options.limits, 1, kFirst),
      log_(receiver, summary_) {
  validate(options);
  validate(ends, options.limits.axes);
}

void LivePlanner::add(const Segment& segment) {
  validate(segment, segments_++, options_.limits.axes);
  summary_.dwell_time += segment.dwell;
  const Vector from = legs_.end();
  const bool moves = legs_.add(segment);
  markers_.add(segment, from, moves);
  if (moves) {
    summary_.path_length += (segment.end - from).norm();
    receiver_.take(segment);
  }
  if (horizon_.in_sight(legs_)) settle_next();
}

Summary LivePlanner::finish() {
  legs_.finish();
  markers_.end_path();
  if (legs_.segments() == 0) begin();
  if (ends_.end_speed > 0) check_end_speed();
  while (legs_.size() > 0) {
    horizon_.in_sight(legs_);
    settle_next();
  }
  log_.finish();
  pass_on(markers_.finish(time_));
  const motion::State end = end_state();
  const auto found = verifier_->finish(end, end.velocity);
  check(found.fault);
  summary_.max_velocity = found.max_velocity;
  summary_.max_acceleration = found.max_acceleration;
  summary_.max_jerk = found.max_jerk;
  summary_.max_feed = found.max_feed;
  summary_.max_contour_error = found.max_contour_error;
  summary_.segments = legs_.segments();
  summary_.cycle_time = time_;
  return summary_;
}

motion::State LivePlanner::end_state() const {
  return {.position = legs_.end(), .velocity = ends_.end_speed * end_direction_};
}

void LivePlanner::check_end_speed() const {
  const std::size_t last = legs_.size() - 1;
  if (legs_.joint(last).stop) {
    throw invalid("path, end_speed", "and a stop at the end of the path exclude each other; leave one out");
  }
  if (ends_.end_speed > legs_.leg(last).feed) {
    throw invalid("path, end_speed",
                  fmt::format("is {} mm/s, but on the last segment the tool may be no faster than {} "
                              "mm/s",
                              ends_.end_speed, legs_.leg(last).feed));
  }
}

// Waits, or goes on from the motion before, as the start asks for it.
void LivePlanner::begin() {
  motion::State start{.position = ends_.start};
  MotionBuilder builder(0);
  if (legs_.segments() == 0) {
    if (ends_.start_speed != 0 || ends_.start_acceleration != 0 || ends_.end_speed != 0) {
      throw invalid("path", "moves nowhere; begin and end it at rest");
    }
    verifier_.emplace(start, options_.limits);
    verifier_->add({.end = ends_.start});  // one segment of no length
  } else {
    const Leg& leg = legs_.leg(0);
    start.velocity = ends_.start_speed * leg.direction;
    start.acceleration = ends_.start_acceleration * leg.direction;
    verifier_.emplace(start, options_.limits);
    show_path(1);
    if (ends_.start_speed != 0 || ends_.start_acceleration != 0) entry_ = entry_in_motion(leg, builder);
  }
  builder.dwell(ends_.start, legs_.initial_dwell(), 0);
  follow(*verifier_, builder.phases());
  check(verifier_->so_far().fault);
  pass_on(builder.phases());
}

// The motion is settled until it brakes no more.
Entry LivePlanner::entry_in_motion(const Leg& leg, MotionBuilder& builder) const {
  if (legs_.initial_stop()) {
    throw invalid("path, start_speed", "and a stop or a dwell before the first move exclude each other; leave one out");
  }
  motion::LinearState state{0, ends_.start_speed, ends_.start_acceleration};
  if (std::abs(state.acceleration) > leg.acceleration) {
    throw invalid("path, start_acceleration",
                  fmt::format("is {} mm/s², beyond the axes' limits; along the first segment they allow {}",
                              state.acceleration, leg.acceleration));
  }
  if (state.acceleration < 0) state = builder.settle(leg, state);
  const CornerMotion motion{.speed = state.velocity, .acceleration = state.acceleration};
  if (ends_.start_speed > leg.feed || state.velocity < 0 || state.position >= leg.length ||
      motion.level(leg.jerk) > leg.feed) {
    throw invalid("path, start_speed",
                  fmt::format("is {} mm/s with {} mm/s²: the tool would leave the first segment, or be faster than {} "
                              "mm/s, before it can change that; start where it can",
                              ends_.start_speed, ends_.start_acceleration, leg.feed));
  }
  return {.taken = state.position,
          .motion = motion,
          .need = ramp_from(leg, leg_end(motion, leg), leg.feed).distance,
          .rests = false,
          .in_motion = BegunStretch{.last = spline_from(leg, state)}};
}

// Settles the first part of what is in sight.
void LivePlanner::settle_next() {
  if (!verifier_) begin();
  // A path that is seen whole is compared with taking its corners one by one (compare_corners); its parts are not.
  const bool alone = sees_all(horizon_);
  std::unique_ptr<Section> apart;
  std::size_t until_apart = 0;
  const auto settle_up_to = [&](const Horizon& horizon) {
    auto section = plan(horizon, options_.strategy);
    if (section && !section->taken_apart() && settle(std::move(section), horizon.until())) return true;
    if (section && !(apart && alone)) {
      apart = std::move(section);
      until_apart = horizon.until();
    }
    return false;
  };
  if (settle_up_to(horizon_)) return;
  std::size_t tried = horizon_.legs();
  for (const double share : std::span(kNearer).first(alone ? 1 : kNearer.size())) {
    Horizon nearer(options_.limits, share, last_ ? 1 : kFirst, shown_);
    nearer.in_sight(legs_);
    if (nearer.legs() == tried) continue;
    tried = nearer.legs();
    if (settle_up_to(nearer)) return;
  }
  if (apart && settle(std::move(apart), until_apart)) return;
  if (follow_last()) return;
  // Smooth motions through many corners are found by trying; corners one by one are inside the limits by themselves.
  auto section =
      plan(horizon_, options_.strategy == CornerStrategy::kAuto ? CornerStrategy::kBlended : options_.strategy);
  if (!section) {
    throw invalid("path, start_speed", fmt::format("is {} mm/s, and the tool cannot brake from there to the first "
                                                   "corners; start more slowly",
                                                   ends_.start_speed));
  }
  const double end_speed = section->end_speed();
  if (settle(std::move(section), horizon_.until())) return;
  if (at_end(horizon_.legs()) && end_speed < ends_.end_speed) {
    throw invalid("path, end_speed", fmt::format("is {} mm/s, but the path is too short, or bends too "
                                                 "much at its end, to get faster than {} mm/s",
                                                 ends_.end_speed, end_speed));
  }
  check(fault_);
}

std::unique_ptr<Section> LivePlanner::plan(const Horizon& horizon, CornerStrategy strategy) const {
  PlanOptions options = options_;
  options.strategy = strategy;
  const bool alone = sees_all(horizon);
  if (!alone) options.effort = last_ ? Effort::kUsual : Effort::kLeast;
  const double end_speed = at_end(horizon.legs()) ? ends_.end_speed : 0;
  return Section::plan(legs_.first(horizon.legs()), entry_, end_speed, alone, options);
}

bool LivePlanner::at_end(std::size_t leg) const { return legs_.finished() && leg == legs_.size(); }

// From the first leg to the last.
bool LivePlanner::sees_all(const Horizon& horizon) const { return at_end(horizon.legs()) && !last_; }

// Settles a section up to a leg, if the verifier finds nothing wrong with it, to its very end.
bool LivePlanner::settle(std::unique_ptr<Section> section, std::size_t until) {
  const std::size_t legs = section->path().legs.size();
  Section::Cut cut = section->end();
  if (!at_end(legs)) {
    Section::Cut first = section->cut_at(until);
    while (first == section->begin() && until + 1 < legs) first = section->cut_at(++until);
    if (first != section->begin()) cut = first;
  } else if (section->end_speed() < ends_.end_speed) {
    return false;
  }
  section->tighten(cut);
  section->build(time_);
  motion::Verifier settled = *verifier_;
  std::swap(settled, *verifier_);  // to come back to if something is wrong
  const std::size_t shown = shown_;
  show_path(legs);
  follow(*verifier_, section->phases(section->begin(), cut));
  fault_ = verifier_->so_far().fault;
  if (!at_end(legs) && fault_.empty()) {
    motion::Verifier to_rest = *verifier_;
    follow(to_rest, section->phases(cut, section->end()));
    fault_ = to_rest.finish({.position = section->path().legs.back().end}).fault;
  }
  if (!fault_.empty()) {
    std::swap(settled, *verifier_);
    shown_ = shown;
    return false;
  }
  last_ = std::move(section);
  go_on(last_->begin(), cut, 0);
  return true;
}

// The last section leads to rest.
bool LivePlanner::follow_last() {
  if (!last_ || cut_ == last_->end()) return false;
  const Section::Cut next = last_->cut_after(cut_);
  follow(*verifier_, last_->phases(cut_, next));
  check(verifier_->so_far().fault);
  go_on(cut_, next, last_->rest_from(cut_).first_leg);
  return true;
}

// `dropped`: legs of the last section that the queue has dropped already.
void LivePlanner::go_on(const Section::Cut& from, const Section::Cut& to, std::size_t dropped) {
  pass_on(last_->phases(from, to));
  summary_.time_at_feed += last_->record(from, to, log_);
  auto [first_leg, entry] = last_->rest_from(to);
  const std::size_t done = first_leg - dropped;
  if (done > 0) end_direction_ = legs_.leg(done - 1).direction;
  legs_.drop(done);
  shown_ -= done;
  horizon_ = Horizon(options_.limits, 1, 1, shown_);
  entry_ = std::move(entry);
  cut_ = to;
}

void LivePlanner::pass_on(std::span<const motion::Phase> phases) {
  for (const motion::Phase& phase : phases) {
    throw_if_stopped(options_.stop);
    pass_on(markers_.follow(phase));
    receiver_.take(phase);
  }
  if (!phases.empty()) time_ = phases.back().end_time();
}

void LivePlanner::pass_on(std::span<const MarkerAt> markers) {
  summary_.markers += markers.size();
  for (const MarkerAt& marker : markers) receiver_.take(marker);
}

// Shows the first legs to the verifier.
void LivePlanner::show_path(std::size_t legs) {
  for (; shown_ < legs; ++shown_) {
    throw_if_stopped(options_.stop);
    double reach = 0;
    if (!at_end(shown_ + 1) && !legs_.joint(shown_).stop) {
      reach = corner_geometry(legs_.leg(shown_), legs_.leg(shown_ + 1), options_).reach;
    }
    legs_.segments_of(shown_, reach, [&](const motion::PathSegment& segment) { verifier_->add(segment); });
  }
}

void LivePlanner::follow(motion::Verifier& verifier, std::span<const motion::Phase> phases) const {
  for (const motion::Phase& phase : phases) {
    throw_if_stopped(options_.stop);
    verifier.follow(phase);
  }
}

void LivePlanner::check(const std::string& fault) {
  if (!fault.empty()) throw std::logic_error("the plan failed its verification and is not served: " + fault);
}

}  // namespace kcs::planning
