#include "client/gateway/simulated_drive.h"

#include <cmath>

namespace kcs::gateway {
namespace {

constexpr double kLongestSampling = 1e-4;  // s; the paper's closed-loop sampling time
constexpr int kSlideSteps = 10;            // of the slide in one sampling time

double to_counts(double position, double resolution) { return std::round(position / resolution) * resolution; }

}  // namespace

SimulatedDrive::SimulatedDrive(const DriveParameters& parameters, double position_mm)
    : SimulatedDrive(parameters, tune_servo(parameters.slide.mass_kg, parameters.bandwidth_hz), position_mm) {}

SimulatedDrive::SimulatedDrive(const DriveParameters& parameters, const ServoGains& gains, double position_mm)
    : encoder_resolution_(parameters.encoder_resolution_mm),
      slide_(parameters.slide, position_mm),
      servo_(gains, parameters.force_limit_n, to_counts(position_mm, parameters.encoder_resolution_mm)),
      commanded_(position_mm) {}

void SimulatedDrive::follow(double commanded_mm, double period_s) {
  // A hair of tolerance, so that a period of a whole number of sampling times is not cut once more by rounding.
  const int samples = std::max(1, static_cast<int>(std::ceil(period_s / kLongestSampling - 1e-6)));
  const double sampling = period_s / samples;
  const double speed = (commanded_mm - commanded_) / period_s;
  for (int sample = 0; sample < samples; ++sample) {
    const double force = servo_.force_n(commanded_ + speed * (sample * sampling), speed, encoder_mm(), sampling);
    for (int step = 0; step < kSlideSteps; ++step) slide_.push(force, sampling / kSlideSteps);
  }
  commanded_ = commanded_mm;
}

double SimulatedDrive::encoder_mm() const { return to_counts(slide_.position_mm(), encoder_resolution_); }

}  // namespace kcs::gateway
