#include "tests/bench/speed/paths.h"

#include <cmath>
#include <numbers>
#include <random>

namespace kcs::bench {
namespace {

using planning::Vector;

// Point 0 is the start.
template <class Point>
planning::Toolpath path_through(std::size_t segments, Point point) {
  planning::Toolpath path;
  path.start = point(0);
  path.segments.reserve(segments);
  for (std::size_t i = 1; i <= segments; ++i) {
    path.segments.push_back({.end = point(i), .feed = kFeed, .tolerance = kTolerance});
  }
  return path;
}

}  // namespace

planning::Toolpath circle(std::size_t segments) {
  constexpr double kRadius = 10, kChord = 0.1;
  return path_through(segments, [&](std::size_t i) -> Vector {
    const double angle = static_cast<double>(i) * kChord / kRadius;
    return kRadius * Vector(std::sin(angle), 1 - std::cos(angle), 0);
  });
}

planning::Toolpath spiral(std::size_t segments) {
  constexpr double kChord = 0.3, kPitch = 0.5, kNoise = 0.001;
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> noise(-kNoise, kNoise);
  return path_through(segments, [&](std::size_t i) -> Vector {
    // The length of an Archimedean spiral grows with the square of its angle.
    const double angle =
        2 * std::numbers::pi + std::sqrt(4 * std::numbers::pi * kChord * static_cast<double>(i) / kPitch);
    const double radius = kPitch * angle / (2 * std::numbers::pi);
    return {radius * std::cos(angle) + noise(random), radius * std::sin(angle) + noise(random), 0};
  });
}

planning::Toolpath relief(std::size_t segments) {
  constexpr std::size_t kPass = 500;  // segments
  constexpr double kChord = 0.2, kStepOver = 0.3, kWave = 20, kHeight = 3;
  return path_through(segments, [&](std::size_t i) -> Vector {
    const std::size_t pass = i / (kPass + 1), along = i % (kPass + 1);
    const double x = kChord * static_cast<double>(pass % 2 == 0 ? along : kPass - along);
    const double y = kStepOver * static_cast<double>(pass);
    const double wave = 2 * std::numbers::pi / kWave;
    return {x, y, kHeight * std::sin(wave * x) * std::cos(wave * y)};
  });
}

planning::Toolpath zigzag(std::size_t segments) {
  constexpr double kLength = 20, kHalfAngle = std::numbers::pi / 12;
  return path_through(segments, [&](std::size_t i) -> Vector {
    return kLength * Vector(i % 2 == 0 ? 0 : std::cos(kHalfAngle), static_cast<double>(i) * std::sin(kHalfAngle), 0);
  });
}

}  // namespace kcs::bench
