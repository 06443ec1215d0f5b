#include "tests/soak/resources.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>

namespace kcs::soak {
namespace {

constexpr double kWarmUp = 60;    // s
constexpr double kShortest = 60;  // s after that: in less, one large plan decides on the slope
constexpr double kMegabyte = 1 << 20;
// A minute. The server serves one to two thousand calls in it, of which half make or load a plan of 10 kB to 5 MB: a
// leak of a plan, or of 4 kB a call, is more than this. What the allocator and the pages of the database come to was 1
// to 3 MB.
constexpr double kMostGrowth = 4 * kMegabyte;

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace

void Life::add(double time, const Resources& resources) { samples_.push_back({time, resources}); }

std::vector<Life::Sample> Life::later() const {
  const auto first = std::find_if(samples_.begin(), samples_.end(), [](const Sample& s) { return s.time >= kWarmUp; });
  return {first, samples_.end()};
}

bool Life::long_enough() const { return seconds() >= kWarmUp + kShortest; }

bool Life::flat() const { return !long_enough() || growth() <= kMostGrowth; }

// From the first quarter of what counts to the last one.
double Life::growth() const {
  const std::vector<Sample> samples = later();
  const std::size_t quarter = samples.size() / 4;
  std::vector<double> first, last;
  for (std::size_t i = 0; i <= quarter; ++i) {
    first.push_back(samples[i].resources.memory);
    last.push_back(samples[samples.size() - 1 - i].resources.memory);
  }
  constexpr double kApart = 0.75;  // of the time that counts
  const double minutes = kApart * (seconds() - kWarmUp) / 60;
  return (median(last) - median(first)) / minutes;
}

std::string Life::row() const {
  double least = 1e300, most = 0, files = 0;
  int threads = 0;
  for (const Sample& sample : samples_) {
    least = std::min(least, sample.resources.memory);
    most = std::max(most, sample.resources.memory);
    files = std::max(files, sample.resources.files);
    threads = std::max(threads, sample.resources.threads);
  }
  return fmt::format(
      "{:>10.0f}{:>12.1f}{:>12.1f}{:>22}{:>12.0f}{:>12}\n", seconds(), least / kMegabyte, most / kMegabyte,
      long_enough() ? fmt::format("{:+.2f}{}", growth() / kMegabyte, flat() ? "" : " TOO MUCH") : "(too short)", files,
      threads);
}

std::string Life::header() {
  return fmt::format("{:>10}{:>12}{:>12}{:>22}{:>12}{:>12}\n{:>10}{:>12}{:>12}{:>22}{:>12}{:>12}\n", "Life", "memory",
                     "memory", "slope after the", "open files", "threads", "s", "least, MB", "most, MB",
                     "1st minute, MB/min", "most", "most");
}

}  // namespace kcs::soak
