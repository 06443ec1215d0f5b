#include "server/runs/clock_course.h"

namespace kcs::runs {

void ClockCourse::add(const ClockPhase& stretch, const ClockState& end) {
  stretches_.push_back(stretch);
  end_ = end;
  duration_ += stretch.duration;
}

ClockCourse ClockCourse::cut(double duration) {
  ClockCourse kept(stretches_.empty() ? end_ : stretches_.front().start), rest = kept;
  for (const ClockPhase& stretch : stretches_) {
    const bool last = &stretch == &stretches_.back();
    const ClockState end = last ? end_ : (&stretch)[1].start;
    const double left = duration - kept.duration();
    if (left >= stretch.duration) {
      kept.add(stretch, end);
      continue;
    }
    ClockPhase beyond = stretch;
    if (left > 0) {
      kept.add({stretch.start, stretch.bend, left}, stretch.at(left));
      beyond = {kept.end(), stretch.bend, stretch.duration - left};
    }
    if (rest.stretches_.empty()) rest.end_ = kept.end();
    rest.add(beyond, end);
  }
  if (rest.stretches_.empty()) rest.end_ = kept.end();
  *this = kept;
  return rest;
}

}  // namespace kcs::runs
