#include "client/cli/time_series.h"

#include <algorithm>

namespace kcs::cli {

TimeSeries::TimeSeries(double from, double to, std::size_t slots)
    : from_(from), slot_length_((to - from) / static_cast<double>(slots)), slots_(slots) {}

void TimeSeries::add(double time, double value) {
  const auto index = static_cast<std::size_t>(std::max(0.0, (time - from_) / slot_length_));
  Slot& slot = slots_[std::min(index, slots_.size() - 1)];
  if (!slot.used || value < slot.lowest.value) slot.lowest = {time, value};
  if (!slot.used || value > slot.highest.value) slot.highest = {time, value};
  slot.used = true;
}

std::vector<std::pair<double, double>> TimeSeries::points() const {
  std::vector<std::pair<double, double>> points;
  for (const Slot& slot : slots_) {
    if (!slot.used) continue;
    const auto [first, second] =
        std::minmax(slot.lowest, slot.highest, [](const Sample& a, const Sample& b) { return a.time < b.time; });
    points.emplace_back(first.time, first.value);
    if (second.time > first.time) points.emplace_back(second.time, second.value);
  }
  return points;
}

}  // namespace kcs::cli
