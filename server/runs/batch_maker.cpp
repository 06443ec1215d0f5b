#include "server/runs/batch_maker.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "server/runs/paced_motion.h"
#include "server/runs/pacing.h"

namespace kcs::runs {

// How a change of pace is looked for: how often it is decided on, s, about, and with which share of the limits. It is
// found to first order of the step; where that was too rough for the verification, the next is tried.
struct BatchMaker::Care {
  double step, share;

  static constexpr std::array<Care, 4> all() { return {{{0.004, 0.98}, {0.002, 0.96}, {0.001, 0.93}, {0.0005, 0.9}}}; }
};

BatchMaker::BatchMaker(const planning::Plan& plan, const motion::AxisLimits& limits, const BatchOptions& options)
    : limits_(limits), options_(options), plan_(plan.trajectory), markers_(plan.markers) {}

std::optional<Batch> BatchMaker::next(const ClockState& from, double rate) {
  plan_.drop_before(from.plan_time);
  for (const Care& care : Care::all()) {
    if (auto found = next(from, rate, care)) return found;
  }
  if (rate > 1) return next(from, 1);
  if (rate > 0 && dwells(from)) return next(from, 0);  // to the end of the dwell
  for (const Care& care : Care::all()) {
    if (auto course = stop(from, care)) {
      const ClockCourse tail = course->cut(duration());
      return batch(from, *course, tail);
    }
  }
  return {};
}

std::optional<Batch> BatchMaker::next(const ClockState& from, double rate, const Care& care) {
  const auto course = lead(from, rate, care);
  if (!course) return {};
  const auto tail = stop(course->end(), care);
  return tail ? std::optional(batch(from, *course, *tail)) : std::nullopt;
}

std::optional<ClockCourse> BatchMaker::lead(const ClockState& from, double rate, const Care& care) {
  Pacing pacing(plan_, limits_, step(care), care.share);
  ClockCourse course(from);
  for (double left = duration(); left > duration() * 1e-9; left = duration() - course.duration()) {
    if (!pacing.lead(course, rate, left)) return {};
  }
  return verified(course) ? std::optional(course) : std::nullopt;
}

std::optional<ClockCourse> BatchMaker::stop(const ClockState& from, const Care& care) {
  const double longest = static_cast<double>(options_.tail_capacity) * options_.period;
  Pacing pacing(plan_, limits_, step(care), care.share);
  ClockCourse course(from);
  while (!at_rest(course.end())) {
    if (!pacing.lead(course, 0, longest) || course.duration() > longest) return {};
  }
  return verified(course) ? std::optional(course) : std::nullopt;
}

// The same on the way and on the way to rest: what one finds safe, the other finds as well.
double BatchMaker::step(const Care& care) const { return duration() / std::ceil(duration() / care.step); }

bool BatchMaker::verified(const ClockCourse& course) {
  return std::all_of(course.stretches().begin(), course.stretches().end(),
                     [&](const ClockPhase& stretch) { return verify(plan_, stretch, limits_).empty(); });
}

// The first `count` times end exactly where what comes next goes on; none is beyond, neither by rounding nor because
// the clock runs on after the plan's end.
void BatchMaker::settle(std::vector<double>& times, std::size_t count, double end) {
  for (std::size_t i = 0; i < count; ++i) times[i] = std::min(times[i], end);
  times[count - 1] = end;
}

Batch BatchMaker::batch(const ClockState& from, const ClockCourse& course, const ClockCourse& tail) {
  MarkedCourse way{.from = from.plan_time};
  Batch made{.positions = sample(course, options_.setpoints, way.times), .end = course.end()};
  made.end_of_plan = has_ended(made.end);
  if (made.end_of_plan) {
    made.end = {plan_.duration(), 0, 0};
    while (way.times.size() > 1 && way.times.end()[-2] >= plan_.duration()) way.times.pop_back();
    made.positions.resize(way.times.size());
  } else {
    const double periods = tail.duration() / options_.period;
    made.tail = sample(tail, static_cast<std::size_t>(std::ceil(periods * (1 - 1e-12))), way.times);
  }
  made.tail_end = made.end_of_plan ? plan_.duration() : std::min(tail.end().plan_time, plan_.duration());
  way.setpoints = made.positions.size();
  way.to_end = made.end_of_plan;
  settle(way.times, way.setpoints, made.end.plan_time);
  if (!made.tail.empty()) settle(way.times, way.times.size(), made.tail_end);
  made.markers = markers_on(way, markers_);
  return made;
}

// A setpoint each period after the start; beyond the course's end it rests. Adds the plan's time at each to `times`.
std::vector<motion::Vector> BatchMaker::sample(const ClockCourse& course, std::size_t count,
                                               std::vector<double>& times) {
  std::vector<motion::Vector> positions;
  positions.reserve(count);
  auto stretch = course.stretches().begin();
  double start = 0;
  for (std::size_t i = 1; i <= count; ++i) {
    const double time = static_cast<double>(i) * options_.period;
    while (stretch != course.stretches().end() && time > start + stretch->duration) start += (stretch++)->duration;
    const bool beyond = stretch == course.stretches().end();
    times.push_back(beyond ? course.end().plan_time : stretch->at(time - start).plan_time);
    positions.push_back(position(plan_, times.back()));
  }
  return positions;
}

}  // namespace kcs::runs
