#include "client/cli/plan_table.h"

#include <fmt/format.h>

#include <cstdint>
#include <iterator>
#include <sstream>
#include <utility>

#include "client/cli/numbers.h"
#include "client/cli/slow_spots.h"
#include "client/common/names.h"

namespace kcs::cli {
namespace {

constexpr std::size_t kWidth = 80;
constexpr std::size_t kLabelWidth = 20;
constexpr std::size_t kSlowestSpots = 10;

// Text that grows by formatted pieces.
class Table {
 public:
  template <typename... Values>
  void add(fmt::format_string<Values...> format, Values&&... values) {
    fmt::format_to(std::back_inserter(text_), format, std::forward<Values>(values)...);
  }

  void row(std::string_view label, std::string_view value) { add("{:<{}}{}\n", label, kLabelWidth, value); }

  // `text` broken between words, its lines after the first indented to stand below its start.
  void paragraph(std::string_view label, const std::string& text) {
    std::istringstream words(text);
    std::string line = fmt::format("{:<{}}", label, kLabelWidth);
    bool line_is_empty = true;
    for (std::string word; words >> word; line_is_empty = false) {
      if (!line_is_empty && line.size() + 1 + word.size() > kWidth) {
        add("{}\n", line);
        line = std::string(kLabelWidth, ' ');
        line_is_empty = true;
      }
      line += (line_is_empty ? "" : " ") + word;
    }
    add("{}\n", line);
  }

  const std::string& text() const { return text_; }

 private:
  std::string text_;
};

// How the corners are taken, as far as it occurs.
void add_strategies(Table& table, const client::Summary& s) {
  const auto add = [&table](std::string_view strategy, std::uint64_t count) {
    if (count > 0) table.row(strategy, with_commas(count));
  };
  add("  interrupted", s.interrupted_count);
  add("  uninterrupted", s.uninterrupted_count);
  add("  blended", s.blended_count);
  add("  overlapping", s.overlapping_count);
  add("  exact stops", s.exact_stop_count);
}

void add_figures(Table& table, const client::Plan& plan) {
  const client::Summary& s = plan.summary;
  table.row("Cycle time", fmt::format("{}   ({:.3f} s)", clock_time(s.cycle_time_s), s.cycle_time_s));
  table.row("Path", fmt::format("{:.3f} mm in {} segments", s.path_length_mm, with_commas(s.segment_count)));
  table.row("Corners", with_commas(s.corner_count));
  add_strategies(table, s);
  table.row("Lost at corners", fmt::format("{:.3f} s, {} of the cycle time", s.time_lost_at_corners_s,
                                           percentage(s.time_lost_at_corners_s, s.cycle_time_s)));
  table.row("At feed", fmt::format("{:.3f} s, {} of the cycle time", s.time_at_feed_s,
                                   percentage(s.time_at_feed_s, s.cycle_time_s)));
  if (s.dwell_time_s > 0) table.row("Dwells", fmt::format("{:.3f} s", s.dwell_time_s));
  if (s.marker_count > 0) table.row("Markers", with_commas(s.marker_count));
  table.row("Highest feed", fmt::format("{:.2f} mm/s ({:.0f} mm/min)", s.max_feed_mm_s, 60 * s.max_feed_mm_s));
  table.row("Contour error", fmt::format("{:.5f} mm at most; tolerance {} mm ({})", s.max_contour_error_mm,
                                         plan.options.tolerance_mm.value_or(0), name_of(plan.options.tolerance_kind)));
  if (s.max_chord_error_mm > 0) table.row("Chords of arcs", fmt::format("{:.5f} mm at most", s.max_chord_error_mm));
}

void add_maxima_row(Table& table, std::string_view quantity, const std::vector<double>& reached,
                    const std::vector<double>& limits) {
  table.add("{:<{}}", quantity, kLabelWidth);
  for (std::size_t axis = 0; axis < reached.size() && axis < limits.size(); ++axis) {
    table.add("{:>20}", fmt::format("{} / {:.10g}", short_number(reached[axis]), limits[axis]));
  }
  table.add("\n");
}

void add_maxima(Table& table, const client::Plan& plan) {
  const client::Machine& machine = plan.options.machine;
  table.add("\n{:<{}}", "Reached / limit", kLabelWidth);
  for (std::size_t axis = 0; axis < machine.axes && axis < client::kAxisNames.size(); ++axis) {
    table.add("{:>20}", client::kAxisNames[axis]);
  }
  table.add("\n");
  add_maxima_row(table, "  velocity mm/s", plan.summary.max_velocity_mm_s, machine.velocity_mm_s);
  add_maxima_row(table, "  accel. mm/s²", plan.summary.max_acceleration_mm_s2, machine.acceleration_mm_s2);
  add_maxima_row(table, "  jerk mm/s³", plan.summary.max_jerk_mm_s3, machine.jerk_mm_s3);
}

void add_slowest_spots(Table& table, const std::vector<client::Corner>& corners) {
  const std::vector<SlowSpot> spots = slowest_spots(corners, kSlowestSpots);
  if (spots.empty()) return;
  constexpr const char* kHeading = "{:>8}{:>11}{:>11}{:>11}{:>9}{:>10}{:>10}{:>10}\n";
  table.add("\nSlowest spots\n");
  table.add(kHeading, "line", "X", "Y", "Z", "corners", "sharpest", "slowest", "lost");
  table.add(kHeading, "", "mm", "mm", "mm", "", "°", "mm/s", "s");
  for (const SlowSpot& spot : spots) {
    table.add("{:>8}", spot.line);
    for (std::size_t axis = 0; axis < client::kAxisNames.size(); ++axis) {
      table.add("{:>11}", axis < spot.point_mm.size() ? decimal(spot.point_mm[axis], 3) : "");
    }
    table.add("{:>9}{:>10.1f}{:>10.2f}{:>10.3f}\n", spot.corners, spot.largest_angle_deg, spot.lowest_speed_mm_s,
              spot.time_lost_s);
  }
}

void add_notices(Table& table, const std::vector<client::Notice>& notices) {
  if (notices.empty()) return;
  table.add("\nNotices\n");
  for (const client::Notice& notice : notices) {
    const std::string count = notice.count > 1 ? fmt::format(" (×{})", with_commas(notice.count)) : "";
    table.paragraph(fmt::format("  line {}", notice.line), notice.text + count);
  }
}

}  // namespace

std::string plan_table(std::string_view program, const client::Plan& plan, const std::vector<client::Corner>& corners) {
  Table table;
  table.row("Program", program);
  table.row("Machine", plan.options.machine.name);
  add_figures(table, plan);
  add_maxima(table, plan);
  add_slowest_spots(table, corners);
  add_notices(table, plan.notices);
  return table.text();
}

}  // namespace kcs::cli
