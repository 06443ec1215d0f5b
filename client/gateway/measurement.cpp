#include "client/gateway/measurement.h"

#include <algorithm>
#include <cmath>

namespace kcs::gateway {
namespace {

// Contour error is looked for this long before and after: four time constants of a 35 Hz position loop, so longer than
// drives lag, and short enough to stay on the pass that the tool is making.
constexpr double kContourWindow = 0.02;  // s

std::size_t contour_window(double period) {
  return static_cast<std::size_t>(std::max(1.0, std::round(kContourWindow / period)));
}

}  // namespace

Measurement::Measurement(double period_s) : period_(period_s), contour_(contour_window(period_s)) {}

void Measurement::add(const Tick& tick) {
  ++ticks_;
  contour_.add(tick.commanded_mm, tick.actual_mm);
  const Vector following = tick.commanded_mm - tick.actual_mm;
  following_sum_of_squares_ += following.cwiseAbs2();
  following_max_ = following_max_.cwiseMax(following.cwiseAbs());
  if (tick.filling) {
    buffer_min_ = filling_ticks_ == 0 ? tick.buffered : std::min(buffer_min_, tick.buffered);
    buffer_sum_ += static_cast<double>(tick.buffered);
    ++filling_ticks_;
  }
}

RunFigures Measurement::finish() {
  RunFigures figures;
  figures.ticks = ticks_;
  figures.contour = contour_.finish();
  figures.following_max_mm = following_max_;
  if (ticks_ > 0) figures.following_rms_mm = (following_sum_of_squares_ / static_cast<double>(ticks_)).cwiseSqrt();
  if (filling_ticks_ > 0) {
    figures.buffer_min_s = static_cast<double>(buffer_min_) * period_;
    figures.buffer_mean_s = buffer_sum_ / static_cast<double>(filling_ticks_) * period_;
  }
  return figures;
}

}  // namespace kcs::gateway
