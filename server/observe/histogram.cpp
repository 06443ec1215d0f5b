#include "server/observe/histogram.h"

#include <algorithm>
#include <cstddef>
#include <limits>

namespace kcs::observe {

void Histogram::observe(std::chrono::duration<double> time) {
  const auto* const bound = std::lower_bound(kDurationBounds.begin(), kDurationBounds.end(), time.count());
  counts_[static_cast<std::size_t>(bound - kDurationBounds.begin())].fetch_add(1, std::memory_order_relaxed);
  sum_.fetch_add(time.count(), std::memory_order_relaxed);
}

std::uint64_t Histogram::count() const {
  std::uint64_t count = 0;
  for (const auto& bucket : counts_) count += bucket.load(std::memory_order_relaxed);
  return count;
}

void Histogram::expose(SampleWriter writer) const {
  std::uint64_t count = 0;
  for (std::size_t i = 0; i < counts_.size(); ++i) {
    count += counts_[i].load(std::memory_order_relaxed);
    writer.add_bucket(i < kDurationBounds.size() ? kDurationBounds[i] : std::numeric_limits<double>::infinity(), count);
  }
  writer.add("_sum", sum_.load(std::memory_order_relaxed));
  writer.add("_count", count);
}

}  // namespace kcs::observe
