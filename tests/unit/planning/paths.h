// Small tool paths for tests.
#pragma once

#include <cmath>
#include <initializer_list>
#include <numbers>

#include "server/planning/leg_queue.h"
#include "server/planning/plan_path.h"

namespace kcs::planning {

// From zero through `points` at one feed and tolerance.
inline Toolpath path_through(std::initializer_list<Vector> points, double feed, double tolerance) {
  Toolpath path;
  for (const Vector& point : points) path.segments.push_back({.end = point, .feed = feed, .tolerance = tolerance});
  return path;
}

// Two legs of 10 mm, the first along X, that meet at `degrees`.
inline Toolpath two_legs(double degrees, double tolerance, double feed = 100) {
  const double angle = degrees * std::numbers::pi / 180;
  return path_through({{10, 0, 0}, {10 + 10 * std::cos(angle), 10 * std::sin(angle), 0}}, feed, tolerance);
}

// So many legs of `length` mm, each turned by `degrees` from the one before; 100 mm/s, tolerance 0.05 mm.
inline Toolpath turning_legs(int count, double length, double degrees) {
  Toolpath path;
  Vector end = Vector::Zero();
  for (int i = 0; i < count; ++i) {
    const double angle = i * degrees * std::numbers::pi / 180;
    end += length * Vector(std::cos(angle), std::sin(angle), 0);
    path.segments.push_back({.end = end, .feed = 100, .tolerance = 0.05});
  }
  return path;
}

// All of a path's legs.
inline LegQueue queue_of(const Toolpath& path, const AxisLimits& limits) {
  LegQueue queue(path.start, limits);
  for (const Segment& segment : path.segments) queue.add(segment);
  queue.finish();
  return queue;
}
inline LegPath legs_of(const Toolpath& path, const AxisLimits& limits) {
  const LegQueue queue = queue_of(path, limits);
  return queue.first(queue.size());
}

// Two axes with the same limits; velocities that no feed of these tests reaches.
inline PlanOptions options_for(double acceleration, double jerk, ToleranceKind kind, CornerStrategy strategy) {
  return {.limits = {2, Vector::Constant(1000), Vector::Constant(acceleration), Vector::Constant(jerk)},
          .tolerance_kind = kind,
          .strategy = strategy};
}

}  // namespace kcs::planning
