#include "tests/bench/stutter/dips.h"

#include <algorithm>
#include <deque>

namespace kcs::bench {
namespace {

constexpr std::size_t kNeighbours = 10;  // segments on either side

// For each sample, the fastest of those before it that are near it.
template <class Near>
std::vector<double> fastest_before(std::span<const SpeedSample> samples, Near near) {
  std::vector<double> fastest;
  std::deque<SpeedSample> window;  // falling speeds
  for (const SpeedSample& sample : samples) {
    while (!window.empty() && !near(window.front().segment, sample.segment)) window.pop_front();
    while (!window.empty() && window.back().speed <= sample.speed) window.pop_back();
    window.push_back(sample);
    fastest.push_back(window.front().speed);
  }
  return fastest;
}

}  // namespace

std::vector<Dip> find_dips(std::span<const SpeedSample> samples, std::span<const Stretch> stretches) {
  const auto near = [&](std::size_t one, std::size_t other) {
    return std::max(one, other) - std::min(one, other) <= kNeighbours && stretches[one].smooth() &&
           stretches[one].first == stretches[other].first;
  };
  const std::vector<double> before = fastest_before(samples, near);
  const std::vector<SpeedSample> backward(samples.rbegin(), samples.rend());
  const std::vector<double> after = fastest_before(backward, near);

  std::vector<Dip> dips;
  bool inside = false;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const Stretch& stretch = stretches[samples[i].segment];
    const double kept = std::min({before[i], after[samples.size() - 1 - i], stretch.allowed});
    const double depth = stretch.smooth() && kept > 0 ? 1 - samples[i].speed / kept : 0;
    if (depth > 0) {
      if (!inside) dips.push_back({samples[i], depth});
      if (depth > dips.back().depth) dips.back() = {samples[i], depth};
    }
    inside = depth > 0;
  }
  return dips;
}

}  // namespace kcs::bench
