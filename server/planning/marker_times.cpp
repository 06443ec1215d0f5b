#include "server/planning/marker_times.h"

#include <algorithm>
#include <array>
#include <utility>

#include "server/motion/polynomial.h"

namespace kcs::planning {
namespace {

// Where the sum of two directions is shorter, the path turns back: no plane tells the way there from the way back.
constexpr double kReversal = 0.1;

// Corners are kept where the path has turned by as much as this, the cosine of 30°, since the one before.
constexpr double kTurned = 0.866;

}  // namespace

void MarkerTimes::add(const Segment& segment, const Vector& from, bool moves) {
  if (moves) {
    const Vector direction = (segment.end - from).normalized();
    here_.after = direction;
    const std::uint32_t segments = here_.segments + 1;
    end_path();
    here_ = {.segments = segments, .point = segment.end, .before = direction};
  }
  here_.stops = here_.stops || segment.stop || segment.dwell > 0;
  if (segment.marker.kind != MarkerKind::kNone) put(segment.marker);
  if (segment.dwell > 0) {
    put({.kind = MarkerKind::kDwellBegins});
    here_.dwell += segment.dwell;
    put({.kind = MarkerKind::kDwellEnds});
  }
}

void MarkerTimes::put(const Marker& marker) {
  here_.items.push_back({here_.dwell, marker});
  ++waiting_;
}

void MarkerTimes::end_path() {
  const bool turned = here_.after.dot(direction_) < kTurned;
  if (turned) direction_ = here_.after;
  if (turned || !here_.items.empty()) places_.push_back(std::exchange(here_, {}));
}

const std::vector<MarkerAt>& MarkerTimes::follow(const motion::Phase& phase) {
  given_.clear();
  while (!places_.empty()) {
    const std::optional<double> time = arrival(places_.front(), phase);
    if (!time) break;
    passed_ = std::max(passed_, *time);
    give(*time);
  }
  return given_;
}

const std::vector<MarkerAt>& MarkerTimes::finish(double time) {
  given_.clear();
  while (!places_.empty()) give(time);
  return given_;
}

// Those of the first place, at which the tool is at `time`.
void MarkerTimes::give(double time) {
  for (const Item& item : places_.front().items) {
    last_ = std::max(last_, time + item.rest);
    given_.push_back({last_, item.marker});
  }
  waiting_ -= places_.front().items.size();
  places_.pop_front();
}

// When the phase comes to the place; nothing if it ends before.
std::optional<double> MarkerTimes::arrival(const Place& place, const motion::Phase& phase) const {
  if (phase.segments.first >= place.segments) return phase.start_time;
  if (phase.segments.last + 1 < place.segments) return {};
  if (place.stops) return phase.rests() ? std::optional(phase.start_time) : std::nullopt;
  const Vector normal = place.before + place.after;
  const motion::State& start = phase.start;
  std::array<double, 4> beyond{};  // mm, of time; at a reversal the speed back, mm/s
  if (normal.norm() > kReversal) {
    beyond = {(start.position - place.point).dot(normal), start.velocity.dot(normal),
              start.acceleration.dot(normal) / 2, phase.jerk.dot(normal) / 6};
  } else {
    beyond = {-start.velocity.dot(place.before), -start.acceleration.dot(place.before),
              -phase.jerk.dot(place.before) / 2, 0};
  }
  const auto at = [&beyond](double t) { return beyond[0] + t * (beyond[1] + t * (beyond[2] + t * beyond[3])); };
  const double end = phase.duration, begin = std::clamp(passed_ - phase.start_time, 0.0, end);
  if (!(at(end) > 0)) return {};
  return phase.start_time + (at(begin) < 0 ? motion::root_between(beyond, begin, end) : begin);
}

}  // namespace kcs::planning
