#include "client/gateway/slide.h"

#include <algorithm>
#include <cmath>

namespace kcs::gateway {
namespace {

constexpr double kMillimetresPerMetre = 1000;

}  // namespace

Slide::Slide(const SlideParameters& parameters, double position_mm) : parameters_(parameters), position_(position_mm) {}

void Slide::push(double force_n, double seconds) {
  const double speed_per_newton = seconds / parameters_.mass_kg * kMillimetresPerMetre;
  const double free_speed = speed_ + speed_per_newton * (force_n - parameters_.viscous_n_s_per_mm * speed_);
  const double braked_speed = std::max(0.0, std::abs(free_speed) - speed_per_newton * dry_friction_n());
  const double speed = std::copysign(braked_speed, free_speed);
  position_ += seconds * (speed_ + speed) / 2;
  speed_ = speed;
}

double Slide::dry_friction_n() const {
  const double ratio = speed_ / parameters_.stribeck_speed_mm_s;
  return parameters_.coulomb_n + (parameters_.static_n - parameters_.coulomb_n) * std::exp(-ratio * ratio);
}

}  // namespace kcs::gateway
