#include "client/gateway/simulated_table.h"

namespace kcs::gateway {

std::vector<DriveParameters> table_drives() {
  constexpr double kBandwidth = 35;                 // Hz
  constexpr double kEncoderResolution = 0.7125e-3;  // mm
  constexpr double kStribeckSpeed = 2;              // mm/s
  const SlideParameters gantry = {
      .mass_kg = 40, .viscous_n_s_per_mm = 0.1, .coulomb_n = 60, .static_n = 80, .stribeck_speed_mm_s = kStribeckSpeed};
  const SlideParameters carriage = {.mass_kg = 12,
                                    .viscous_n_s_per_mm = 0.05,
                                    .coulomb_n = 30,
                                    .static_n = 40,
                                    .stribeck_speed_mm_s = kStribeckSpeed};
  const DriveParameters x = {
      .slide = gantry, .force_limit_n = 1000, .bandwidth_hz = kBandwidth, .encoder_resolution_mm = kEncoderResolution};
  const DriveParameters y = {
      .slide = carriage, .force_limit_n = 500, .bandwidth_hz = kBandwidth, .encoder_resolution_mm = kEncoderResolution};
  return {x, y, y};
}

SimulatedTable::SimulatedTable(std::size_t axes, const Vector& start_mm) {
  const std::vector<DriveParameters> parameters = table_drives();
  for (std::size_t axis = 0; axis < axes; ++axis) {
    drives_.emplace_back(parameters.at(axis), start_mm[static_cast<Eigen::Index>(axis)]);
  }
}

Vector SimulatedTable::follow(const Vector& commanded_mm, double period_s) {
  Vector measured = Vector::Zero();
  Eigen::Index axis = 0;
  for (SimulatedDrive& drive : drives_) {
    drive.follow(commanded_mm[axis], period_s);
    measured[axis] = drive.encoder_mm();
    ++axis;
  }
  return measured;
}

}  // namespace kcs::gateway
