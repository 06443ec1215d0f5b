#include "client/gateway/report.h"

#include <fmt/format.h>

#include <iterator>
#include <nlohmann/json.hpp>
#include <string_view>
#include <utility>
#include <vector>

#include "client/common/names.h"

namespace kcs::gateway {
namespace {

constexpr double kMicrometres = 1000;  // in a millimetre

// Time between the first setpoint and the last one played.
double played_s(const PlaybackOptions& options, const PlaybackResult& result) {
  return result.figures.ticks == 0 ? 0 : static_cast<double>(result.figures.ticks - 1) * options.period_s;
}

std::string_view end_of_run(const client::Plan& plan, const PlaybackOptions& options, const PlaybackResult& result) {
  if (result.state != PlayState::kFinished) return "starved";
  return options.seconds && *options.seconds < plan.summary.cycle_time_s ? "stopped" : "complete";
}

std::string describe_end(const client::Plan& plan, const PlaybackOptions& options, const PlaybackResult& result) {
  const std::string_view end = end_of_run(plan, options, result);
  if (end == "starved") return "STARVED: no setpoint was there when one was due; the run is void";
  if (end == "stopped") return "ended in mid-motion, as asked for with --seconds";
  return "to the end of the plan";
}

std::string place(const Vector& position, std::size_t axes) {
  std::string text;
  for (std::size_t axis = 0; axis < axes; ++axis) {
    text += fmt::format(" {}{:.3f}", client::kAxisNames.at(axis), position[static_cast<Eigen::Index>(axis)]);
  }
  return text;
}

class Table {
 public:
  template <typename... Values>
  void row(std::string_view label, fmt::format_string<Values...> format, Values&&... values) {
    fmt::format_to(std::back_inserter(text_), "{:<18}{}\n", label,
                   fmt::format(format, std::forward<Values>(values)...));
  }

  const std::string& text() const { return text_; }

 private:
  std::string text_;
};

void add_errors(Table& table, const RunFigures& figures, std::size_t axes, double period) {
  table.row("Contour error", "RMS {:.2f} µm, max {:.2f} µm", figures.contour.rms_mm * kMicrometres,
            figures.contour.max_mm * kMicrometres);
  table.row("  largest", "at {:.4f} s,{} mm", static_cast<double>(figures.contour.max_index) * period,
            place(figures.contour.max_position_mm, axes));
  for (std::size_t axis = 0; axis < axes; ++axis) {
    const auto entry = static_cast<Eigen::Index>(axis);
    table.row(axis == 0 ? "Following error" : "", "{} RMS {:.2f} µm, max {:.2f} µm", client::kAxisNames.at(axis),
              figures.following_rms_mm[entry] * kMicrometres, figures.following_max_mm[entry] * kMicrometres);
  }
}

void add_clock(Table& table, const ClockFigures& clock) {
  table.row("Scheduling", "{}",
            clock.fifo ? "real time (SCHED_FIFO)" : "ordinary: real time needs root or CAP_SYS_NICE");
  table.row("Memory", "{}", clock.memory_locked ? "locked" : "not locked: that needs root or CAP_IPC_LOCK");
  table.row("Ticks late by", "p50 {:.0f}, p99 {:.0f}, p99.9 {:.0f}, max {:.0f} µs", clock.lateness.percentile_us(0.5),
            clock.lateness.percentile_us(0.99), clock.lateness.percentile_us(0.999), clock.lateness.max_us());
  table.row("", "{} by more than a period; {} periods passed without one", clock.late_ticks, clock.missed_periods);
}

void add_buffer(Table& table, const PlaybackResult& result) {
  if (const auto& lowest = result.figures.buffer_min_s) {
    table.row("Buffer", "min {:.3f} s, mean {:.3f} s of {:.3f} s", *lowest, *result.figures.buffer_mean_s,
              result.buffer_capacity_s);
  } else {
    table.row("Buffer", "held the whole motion from the start");
  }
}

// The first entries of a vector, one per axis.
std::vector<double> numbers(const Vector& vector, std::size_t axes) { return {vector.data(), vector.data() + axes}; }

}  // namespace

std::string report_table(const client::Plan& plan, const PlaybackOptions& options, const PlaybackResult& result) {
  const std::size_t axes = plan.options.machine.axes;
  Table table;
  table.row("Plan", "{}", plan.name);
  table.row("Cycle time", "{:.4f} s", plan.summary.cycle_time_s);
  table.row("Played", "{:.4f} s, {} ticks of {:g} ms, {}", played_s(options, result), result.figures.ticks,
            options.period_s * 1000, options.simulated_time ? "in simulated time" : "by the clock");
  table.row("", "{}", describe_end(plan, options, result));
  add_errors(table, result.figures, axes, options.period_s);
  if (result.clock) {
    add_clock(table, *result.clock);
    add_buffer(table, result);
  }
  table.row("Resumptions", "{}", result.resumptions);
  if (result.unmeasured_ticks > 0) table.row("Not measured", "{} ticks", result.unmeasured_ticks);
  if (!result.feed_failure.empty()) table.row("Setpoints ended", "{}", result.feed_failure);
  return table.text();
}

std::string report_json(const client::Plan& plan, const PlaybackOptions& options, const PlaybackResult& result) {
  const std::size_t axes = plan.options.machine.axes;
  const RunFigures& figures = result.figures;
  nlohmann::ordered_json json = {
      {"plan", plan.name},
      {"cycle_time_s", plan.summary.cycle_time_s},
      {"period_s", options.period_s},
      {"end", end_of_run(plan, options, result)},
      {"ticks", figures.ticks},
      {"played_s", played_s(options, result)},
      {"contour_error_rms_mm", figures.contour.rms_mm},
      {"contour_error_max_mm", figures.contour.max_mm},
      {"contour_error_max_time_s", static_cast<double>(figures.contour.max_index) * options.period_s},
      {"contour_error_max_position_mm", numbers(figures.contour.max_position_mm, axes)},
      {"following_error_rms_mm", numbers(figures.following_rms_mm, axes)},
      {"following_error_max_mm", numbers(figures.following_max_mm, axes)},
      {"resumptions", result.resumptions},
      {"unmeasured_ticks", result.unmeasured_ticks},
      {"simulated_time", options.simulated_time},
  };
  if (const auto& clock = result.clock) {
    json["real_time_scheduling"] = clock->fifo;
    json["memory_locked"] = clock->memory_locked;
    json["lateness_us"] = {{"p50", clock->lateness.percentile_us(0.5)},
                           {"p99", clock->lateness.percentile_us(0.99)},
                           {"p99_9", clock->lateness.percentile_us(0.999)},
                           {"max", clock->lateness.max_us()}};
    json["late_ticks"] = clock->late_ticks;
    json["missed_periods"] = clock->missed_periods;
    json["buffer_capacity_s"] = result.buffer_capacity_s;
    if (figures.buffer_min_s) json["buffer_min_s"] = *figures.buffer_min_s;
    if (figures.buffer_mean_s) json["buffer_mean_s"] = *figures.buffer_mean_s;
  }
  if (!result.feed_failure.empty()) json["setpoints_ended"] = result.feed_failure;
  return json.dump(2) + "\n";
}

}  // namespace kcs::gateway
