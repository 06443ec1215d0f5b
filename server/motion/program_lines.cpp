#include "server/motion/program_lines.h"

#include <algorithm>
#include <iterator>

namespace kcs::motion {

void ProgramLines::add(std::uint32_t line) {
  if (!runs_.empty() && segments_ - runs_.back().first == 1) runs_.back().step = line - runs_.back().line;
  if (runs_.empty() || runs_.back().line_of(segments_) != line) runs_.push_back({segments_, line, 0});
  ++segments_;
}

std::uint32_t ProgramLines::of(std::uint32_t segment) const {
  const auto next =
      std::partition_point(runs_.begin(), runs_.end(), [&](const Run& run) { return run.first <= segment; });
  return next == runs_.begin() ? 0 : std::prev(next)->line_of(segment);
}

void ProgramLines::forget_before(std::uint32_t segment) {
  while (runs_.size() > 1 && runs_[1].first <= segment) runs_.pop_front();
}

}  // namespace kcs::motion
