// The moving mass of one axis on its guideway: what the motor's force does to it.
#pragma once

namespace kcs::gateway {

// A slide and the friction of its guideway.
struct SlideParameters {
  double mass_kg = 1;              // > 0
  double viscous_n_s_per_mm = 0;   // friction that grows with the speed
  double coulomb_n = 0;            // friction that does not
  double static_n = 0;             // holds the slide at rest; at least coulomb_n
  double stribeck_speed_mm_s = 1;  // > 0; the speed over which static friction gives way to Coulomb friction
};

// A rigid mass on a guideway with viscous, Coulomb and static friction (Stribeck's curve between the last two).
//
// Friction is treated as an impulse that takes away at most the speed that is there (time stepping after Moreau). So
// the slide comes to rest, stays at rest and breaks loose without any threshold speed to choose, however long the step.
class Slide {
 public:
  Slide(const SlideParameters& parameters, double position_mm);

  // Applies a constant force, in newtons, for some seconds, short against the time in which the speed changes.
  void push(double force_n, double seconds);

  double position_mm() const { return position_; }
  double speed_mm_s() const { return speed_; }  // with its sign

 private:
  double dry_friction_n() const;

  SlideParameters parameters_;
  double position_;   // mm
  double speed_ = 0;  // mm/s
};

}  // namespace kcs::gateway
