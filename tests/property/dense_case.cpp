#include "tests/property/dense_case.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>

#include "tests/property/random.h"

namespace kcs::test {
namespace {

using planning::ToleranceKind;
using planning::Vector;

class DenseMaker : Random {
 public:
  using Random::Random;

  Case make() {
    make_options();
    make_path();
    return std::move(case_);
  }

 private:
  // A place for each arc length (or nearly), mm.
  using Curve = std::function<Vector(double)>;

  void make_options() {
    auto& limits = case_.options.limits;
    limits.axes = one_of<std::size_t>({2, 3});
    const bool wild = chance(0.1);
    const double spread = wild ? 10 : one_of({1.0, 3.0});
    const double v = wild ? log_uniform(5, 2000) : log_uniform(100, 1000);
    const double a = wild ? log_uniform(50, 50000) : log_uniform(300, 10000);
    const double j = a * (wild ? log_uniform(3, 300) : log_uniform(20, 200));
    for (std::size_t axis = 0; axis < limits.axes; ++axis) {
      limits.velocity[axis] = v * log_uniform(1 / spread, spread);
      limits.acceleration[axis] = a * log_uniform(1 / spread, spread);
      limits.jerk[axis] = j * log_uniform(1 / spread, spread);
    }
    case_.options.tolerance_kind =
        one_of({ToleranceKind::kContourError, ToleranceKind::kContourError, ToleranceKind::kCornerDistance});
    feed_ = wild ? log_uniform(0.1, 2000) : log_uniform(5, 500);
    tolerance_ = wild ? log_uniform(1e-4, 1) : log_uniform(1e-3, 0.2);
  }

  Curve any_curve() {
    const double radius = log_uniform(0.2, 100), height = log_uniform(0.01, 3);
    switch (bits() % 6) {
      case 0:  // an arc
        return [=](double s) { return Vector(radius * std::cos(s / radius), radius * std::sin(s / radius), 0); };
      case 1: {  // a spiral whose turns lie `height` apart
        return [=](double s) {
          const double pitch = height / 6.3, angle = std::sqrt(2 * s / pitch + radius * radius);
          return Vector(pitch * angle * std::cos(angle), pitch * angle * std::sin(angle), 0);
        };
      }
      case 2: {  // a free curve: slow waves, one on the other, for each axis
        const Vector first{uniform(0, 6), uniform(0, 6), uniform(0, 6)}, second{uniform(0, 6), uniform(0, 6), 0};
        return [=](double s) {
          const double t = s / radius;
          const auto wave = [&](int i) { return std::sin(t + first[i]) + 0.3 * std::sin(2.7 * t + second[i]); };
          return Vector(0.6 * radius * wave(0), 0.6 * radius * wave(1), 0.6 * radius * wave(2));
        };
      }
      case 3: {  // a relief: up and down on the way along X
        const double wavelength = height * log_uniform(2, 30);
        return [=](double s) { return Vector(s, height * std::sin(6.3 * s / wavelength), 0.2 * s); };
      }
      case 4: {  // an outline: lines, and fillets that turn by `turn` to one side and to the other
        const double line = log_uniform(0.3, 10), fillet = std::min(radius, 5.0), turn = uniform(0.2, 1.6);
        return [=](double s) {
          Vector place = Vector::Zero(), along = Vector::UnitX();
          for (double side = 1; s > 0; side = -side) {
            place += std::min(s, line) * along;
            s -= line;
            if (s <= 0) break;
            const double angle = std::min(s / fillet, turn);
            const Vector across(-side * along.y(), side * along.x(), 0);
            place += fillet * (std::sin(angle) * along + (1 - std::cos(angle)) * across);
            along = std::cos(angle) * along + std::sin(angle) * across;
            s -= fillet * turn;
          }
          return place;
        };
      }
      default: {  // stairs with steps of `height`
        return [=](double s) {
          const double steps = std::floor(s / height), rest = s - steps * height;
          const double up = height * std::floor(steps / 2), side = height * std::ceil(steps / 2);
          return std::fmod(steps, 2) == 0 ? Vector(side + rest, up, 0) : Vector(side, up + rest, 0);
        };
      }
    }
  }

  // What the next segment adds to the arc length, mm.
  std::function<double()> any_lengths() {
    const double step = log_uniform(0.01, 1);
    switch (bits() % 6) {
      case 0:
        return [this] { return log_uniform(1e-5, 10); };
      case 1:
        return [this, step] { return step * log_uniform(1. / 30, 30); };
      case 2:
        return [this, step] { return chance(0.1) ? step : log_uniform(1e-6, 1e-3); };
      default:
        return [step] { return step; };
    }
  }

  void make_path() {
    const Curve curve = any_curve();
    const auto length = any_lengths();
    const double noise = one_of({0.0, 0.0, 1e-3}), stops = one_of({0.0, 0.0, 0.0, 0.01});
    const bool changing_feeds = chance(0.2), changing_tolerances = chance(0.2), leads = chance(0.4);
    Vector offset = Vector::Zero();
    if (chance(0.3)) offset = Vector{uniform(-1000, 1000), uniform(-1000, 1000), uniform(-1000, 1000)};
    const auto at = [&](double s) {
      Vector point = curve(s) + offset;
      for (Eigen::Index axis = 0; axis < 3; ++axis) point[axis] += uniform(-noise, noise);
      return in_space(point);
    };
    double s = 0;
    case_.path.start = at(0);
    if (leads) {
      case_.path.start = in_space(at(0) + Vector{uniform(-50, 50), uniform(-50, 50), 0});
      go(at(0), 0);
    }
    const std::uint64_t count = 20 + bits() % 280;
    for (std::uint64_t i = 0; i < count; ++i) {
      s += length();
      if (changing_feeds && chance(0.05)) feed_ = chance(0.1) ? INFINITY : log_uniform(5, 500);
      if (changing_tolerances && chance(0.05)) tolerance_ = chance(0.1) ? 0 : log_uniform(1e-3, 0.2);
      go(at(s), stops);
    }
    if (leads) go(in_space(at(s) + Vector{uniform(-50, 50), uniform(-50, 50), 0}), 0);
  }

  // Without the axes that the machine does not have.
  Vector in_space(Vector point) const {
    for (std::size_t axis = case_.options.limits.axes; axis < 3; ++axis) point[axis] = 0;
    return point;
  }

  void go(const Vector& end, double stops) {
    planning::Segment segment{.end = end, .feed = feed_, .tolerance = tolerance_};
    segment.stop = chance(stops);
    if (chance(stops)) segment.dwell = uniform(0, 2);
    segment.line = static_cast<std::uint32_t>(case_.path.segments.size() + 1);
    case_.path.segments.push_back(segment);
  }

  Case case_;
  double feed_ = 0;
  double tolerance_ = 0;
};

}  // namespace

Case dense_case(std::uint64_t seed) { return DenseMaker(seed).make(); }

}  // namespace kcs::test
