// Figures of a run, gathered tick by tick.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>

#include "client/gateway/contour_error.h"
#include "client/gateway/trace.h"
#include "client/gateway/vector.h"

namespace kcs::gateway {

struct RunFigures {
  std::uint64_t ticks = 0;
  ContourFigures contour;
  // Commanded less actual position of each axis: what a drive's following-error window sees.
  Vector following_rms_mm = Vector::Zero();
  Vector following_max_mm = Vector::Zero();  // largest magnitudes
  // Motion that was buffered while more was to come; none if the server had sent everything before the first tick.
  std::optional<double> buffer_min_s;
  std::optional<double> buffer_mean_s;
};

class Measurement {
 public:
  // period_s: of the ticks, > 0.
  explicit Measurement(double period_s);

  void add(const Tick& tick);

  // Call once, after the last tick.
  RunFigures finish();

 private:
  double period_;  // s
  ContourError contour_;
  std::uint64_t ticks_ = 0;
  Vector following_sum_of_squares_ = Vector::Zero();  // mm²
  Vector following_max_ = Vector::Zero();             // mm
  std::uint64_t filling_ticks_ = 0;
  std::size_t buffer_min_ = 0;  // setpoints
  double buffer_sum_ = 0;       // setpoints
};

}  // namespace kcs::gateway
