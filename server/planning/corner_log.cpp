#include "server/planning/corner_log.h"

#include <stdexcept>

namespace kcs::planning {
namespace {

std::size_t& count_of(CornerStrategy strategy, Summary& summary) {
  switch (strategy) {
    case CornerStrategy::kInterrupted:
      return summary.interrupted;
    case CornerStrategy::kUninterrupted:
      return summary.uninterrupted;
    case CornerStrategy::kBlended:
      return summary.blended;
    case CornerStrategy::kOverlapping:
      return summary.overlapping;
    case CornerStrategy::kExactStop:
      return summary.exact_stops;
    case CornerStrategy::kAuto:
      break;
  }
  throw std::logic_error("a corner without a strategy");
}

}  // namespace

void CornerLog::add(const Corner& corner) {
  finish();
  last_ = corner;
  last_->time_lost += before_next_;
  before_next_ = 0;
}

void CornerLog::lose_after(double time) {
  if (last_) last_->time_lost += time;
}

void CornerLog::finish() {
  if (!last_) return;
  ++count_of(last_->strategy, summary_);
  summary_.time_lost_at_corners += last_->time_lost;
  receiver_.take(*last_);
  last_.reset();
}

}  // namespace kcs::planning
