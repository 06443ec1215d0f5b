#include "client/gateway/contour_error.h"

#include <algorithm>
#include <cmath>

namespace kcs::gateway {
namespace {

double squared_distance_to_line(const Vector& point, const Vector& start, const Vector& end) {
  const Vector along = end - start;
  const double length_squared = along.squaredNorm();
  const double share = length_squared > 0 ? std::clamp((point - start).dot(along) / length_squared, 0.0, 1.0) : 0.0;
  return (point - start - share * along).squaredNorm();
}

}  // namespace

ContourError::ContourError(std::size_t window) : window_(window), commanded_(2 * window + 1), actual_(window + 1) {}

void ContourError::add(const Vector& commanded_mm, const Vector& actual_mm) {
  commanded_[added_ % commanded_.size()] = commanded_mm;
  actual_[added_ % actual_.size()] = actual_mm;
  ++added_;
  if (added_ > window_) measure(added_ - 1 - window_);
}

ContourFigures ContourError::finish() {
  while (measured_ < added_) measure(measured_);
  return figures_;
}

void ContourError::measure(std::uint64_t tick) {
  const Vector& actual = actual_[tick % actual_.size()];
  const double error = distance_to_path(actual, tick);
  sum_of_squares_ += error * error;
  ++measured_;
  figures_.rms_mm = std::sqrt(sum_of_squares_ / static_cast<double>(measured_));
  if (error > figures_.max_mm) {
    figures_.max_mm = error;
    figures_.max_index = tick;
    figures_.max_position_mm = actual;
  }
}

double ContourError::distance_to_path(const Vector& actual, std::uint64_t tick) const {
  const std::uint64_t first = tick < window_ ? 0 : tick - window_;
  const std::uint64_t last = std::min<std::uint64_t>(tick + window_, added_ - 1);
  double smallest = (actual - commanded(first)).squaredNorm();
  for (std::uint64_t end = first + 1; end <= last; ++end) {
    smallest = std::min(smallest, squared_distance_to_line(actual, commanded(end - 1), commanded(end)));
  }
  return std::sqrt(smallest);
}

}  // namespace kcs::gateway
