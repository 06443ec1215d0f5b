#include "client/cli/plot_data.h"

#include <algorithm>
#include <cmath>

#include "client/cli/time_series.h"

namespace kcs::cli {
namespace {

constexpr std::size_t kSlots = 1500;            // about two for each dot of the picture's width
constexpr std::size_t kMostPathPieces = 14000;  // each is about 100 bytes of an SVG
constexpr double kFinestPeriod = 1e-5;          // s; the server's limit

double length_of(const client::Columns& columns, std::size_t row) {
  double square = 0;
  for (const std::vector<double>& column : columns) square += column[row] * column[row];
  return std::sqrt(square);
}

std::vector<Curve> curves_of(const std::vector<TimeSeries>& series) {
  std::vector<Curve> curves;
  curves.reserve(series.size());
  for (const TimeSeries& axis : series) curves.push_back(axis.points());
  return curves;
}

}  // namespace

PlotData gather_plot_data(client::Planner& planner, const client::Plan& plan, double from_s, double to_s,
                          double coarsest_period_s) {
  const double period =
      std::clamp((to_s - from_s) / (4 * kSlots), kFinestPeriod, std::max(kFinestPeriod, coarsest_period_s));
  auto stream = planner.stream_setpoints(
      plan.name, {.period_s = period,
                  .first_index = static_cast<std::uint64_t>(std::ceil(from_s / period)),
                  .channels = {client::Channel::kVelocity, client::Channel::kAcceleration, client::Channel::kJerk},
                  .last_index = static_cast<std::uint64_t>(std::ceil(to_s / period))});
  const std::size_t axes = plan.options.machine.axes;
  PathOutline path;
  TimeSeries speed(from_s, to_s, kSlots);
  std::vector<TimeSeries> acceleration(axes, speed);
  std::vector<TimeSeries> jerk(axes, speed);
  for (client::SetpointBatch batch; stream.next(batch);) {
    for (std::size_t row = 0; row < batch.size(); ++row) {
      const double time = static_cast<double>(batch.first_index + row) * period;
      const double path_speed = length_of(batch.velocity_mm_s, row);
      path.add({batch.position_mm[0][row], batch.position_mm[1][row], path_speed});
      speed.add(time, path_speed);
      for (std::size_t axis = 0; axis < axes; ++axis) {
        acceleration[axis].add(time, batch.acceleration_mm_s2[axis][row]);
        jerk[axis].add(time, batch.jerk_mm_s3[axis][row]);
      }
    }
  }
  return {.from_s = from_s,
          .to_s = to_s,
          .path = path.strokes(kMostPathPieces),
          .speed = speed.points(),
          .acceleration = curves_of(acceleration),
          .jerk = curves_of(jerk)};
}

}  // namespace kcs::cli
