#include "client/gateway/lateness.h"

#include <algorithm>
#include <cmath>

namespace kcs::gateway {
namespace {

constexpr std::size_t kMicroseconds = 10'000;

}  // namespace

Lateness::Lateness() : ticks_of_microsecond_(kMicroseconds) {}

void Lateness::record(std::int64_t nanoseconds) {
  const std::int64_t late = std::max<std::int64_t>(nanoseconds, 0);
  const auto microsecond = static_cast<std::size_t>(late / 1000);
  if (microsecond < ticks_of_microsecond_.size()) ++ticks_of_microsecond_[microsecond];
  ++ticks_;
  max_ = std::max(max_, late);
}

double Lateness::percentile_us(double share) const {
  const auto wanted = static_cast<std::uint64_t>(std::ceil(share * static_cast<double>(ticks_)));
  std::uint64_t seen = 0;
  for (std::size_t microsecond = 0; microsecond < ticks_of_microsecond_.size(); ++microsecond) {
    seen += ticks_of_microsecond_[microsecond];
    if (seen >= wanted && seen > 0) return std::min(static_cast<double>(microsecond + 1), max_us());
  }
  return max_us();
}

double Lateness::max_us() const { return static_cast<double>(max_) / 1000; }

}  // namespace kcs::gateway
