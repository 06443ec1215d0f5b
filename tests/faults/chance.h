// The random choices of a round of faults: the same seed makes the same ones again.
#pragma once

#include <chrono>
#include <cmath>
#include <random>

namespace kcs::faults {

class Chance {
 public:
  Chance(unsigned seed, double longest_stall_s) : random_(seed), longest_stall_ms_(1000 * longest_stall_s) {}

  std::chrono::milliseconds time(int least_ms, int most_ms) {
    return std::chrono::milliseconds(std::uniform_int_distribution<int>(least_ms, most_ms)(random_));
  }
  // Of a link: as often short as long, from 1 ms on.
  std::chrono::milliseconds stall() {
    return std::chrono::milliseconds(static_cast<int>(std::pow(10, uniform(0, std::log10(longest_stall_ms_)))));
  }
  double uniform(double low, double high) { return std::uniform_real_distribution(low, high)(random_); }

 private:
  std::mt19937 random_;
  double longest_stall_ms_;
};

}  // namespace kcs::faults
