#include "server/runs/plan_window.h"

#include <algorithm>
#include <limits>

namespace kcs::runs {

PlanWindow::PlanWindow(const motion::Trajectory& trajectory) : trajectory_(trajectory), next_(trajectory.begin()) {
  rest_.start_time = trajectory.duration();
  rest_.duration = std::numeric_limits<double>::infinity();
  rest_.start.position = trajectory.final_state().position;
  read_one();
}

std::size_t PlanWindow::find(double time) {
  time = std::max(time, 0.0);  // rounding
  if (time < phases_.front().start_time) restart(time);
  while (phase(last_found_).start_time > time) --last_found_;
  while (phase(last_found_).end_time() <= time) ++last_found_;
  return last_found_;
}

const motion::Phase& PlanWindow::phase(std::size_t number) {
  while (number - first_ >= phases_.size()) read_one();
  return phases_[number - first_];
}

void PlanWindow::drop_before(double time) {
  const std::size_t needed = find(time);
  for (; first_ < needed; ++first_) phases_.pop_front();
}

// Numbers count on: those of before are void.
void PlanWindow::restart(double time) {
  next_ = trajectory_.begin();
  next_.seek(time);
  first_ += phases_.size();
  phases_.clear();
  last_found_ = first_;
}

void PlanWindow::read_one() {
  if (next_ == trajectory_.end()) {
    phases_.push_back(rest_);
  } else {
    phases_.push_back(*next_);
    ++next_;
  }
}

}  // namespace kcs::runs
