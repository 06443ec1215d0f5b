#include "client/cli/plot_script.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <string_view>

#include "client/cli/pixel_grid.h"
#include "client/common/names.h"

namespace kcs::cli {
namespace {

constexpr double kWidth = 1500;  // of the picture, pixels
constexpr double kHeight = 900;

// Colours that people with any kind of colour vision tell apart (Okabe and Ito).
constexpr std::array<std::string_view, 3> kAxisColours = {"0072B2", "D55E00", "009E73"};

// Curves let those below shine through: the first byte of gnuplot's colours is the transparency.
constexpr std::string_view kTranslucent = "#50";

// A limit that lies far above everything that happens would only flatten the curves: it is named, not drawn.
constexpr double kFarAbove = 1.6;

std::string quoted(const std::string& text) {
  std::string result = "'";
  for (const char c : text) result += c == '\'' ? std::string("''") : std::string(1, c);
  return result + "'";
}

double peak_of(const Curve& curve) {
  double peak = 1e-3;
  for (const auto& [time, value] : curve) peak = std::max(peak, std::abs(value));
  return peak;
}

// The heading and the common look.
std::string setup(const std::string& title, const std::string& picture, PictureFormat format) {
  const std::string_view terminal =
      format == PictureFormat::kSvg ? "svg dynamic font 'DejaVu Sans,14'" : "pngcairo font 'DejaVu Sans,11'";
  return fmt::format(
      "set terminal {} size {},{} background 'white' noenhanced\n"
      "set output {}\n"
      "set multiplot title {} noenhanced\n"
      "set border 3 linecolor '#606060'\n"
      "set tics nomirror out textcolor '#202020'\n"
      "set grid linecolor '#e4e4e4' linewidth 1\n"
      "set palette defined (0 '#b2182b', 0.33 '#ef8a1d', 0.66 '#3aa6a0', 1 '#2156a5')\n",
      terminal, kWidth, kHeight, quoted(picture), quoted(title));
}

// The ranges of X and Y that show the whole path in the middle of its panel, at the same scale.
std::string path_ranges(const PlotData& data) {
  constexpr double kPanelWidth = 0.385 * kWidth, kPanelHeight = 0.685 * kHeight, kRoom = 1.06;
  std::vector<OutlinePoint> points;
  for (const Stroke& stroke : data.path) points.insert(points.end(), stroke.begin(), stroke.end());
  const Extent extent(points);
  const double half_width = kRoom / 2 * std::max(extent.width(), extent.height() * kPanelWidth / kPanelHeight);
  const double half_height = half_width * kPanelHeight / kPanelWidth;
  const double x = extent.left() + extent.width() / 2, y = extent.bottom() + extent.height() / 2;
  return fmt::format("set xrange [{:.9g}:{:.9g}]; set yrange [{:.9g}:{:.9g}]\n", x - half_width, x + half_width,
                     y - half_height, y + half_height);
}

std::string path_panel(const PlotData& data) {
  std::string script = "$path << EOD\n";
  for (const Stroke& stroke : data.path) {
    for (const OutlinePoint& point : stroke) {
      fmt::format_to(std::back_inserter(script), "{:.7g} {:.7g} {:.4g}\n", point.x, point.y, point.speed);
    }
    script += "\n";  // lifts the pen
  }
  script += fmt::format(
      "EOD\n"
      "set lmargin at screen 0.065; set rmargin at screen 0.45; set bmargin at screen 0.215; set tmargin at screen "
      "0.9\n"
      "{}"
      "set xlabel 'X, mm'; set ylabel 'Y, mm'\n"
      "set cbrange [0:{:.4g}]\n"
      "set colorbox horizontal user origin screen 0.065, screen 0.105 size screen 0.385, screen 0.018\n"
      "set cblabel 'speed along the path, mm/s' offset 0,0.3\n"
      "plot $path using 1:2:3 with lines linewidth 1.5 linecolor palette notitle\n"
      "unset colorbox\n",
      path_ranges(data), peak_of(data.speed));
  return script;
}

// Builds one of the three diagrams on the right, curve by curve.
class Diagram {
 public:
  // `curves` are all that will come, `limits` those of the axes.
  Diagram(const std::vector<Curve>& curves, const std::vector<double>& limits) {
    double peak = 0;
    for (const Curve& curve : curves) peak = std::max(peak, peak_of(curve));
    top_ = peak;
    for (const double limit : limits) {
      if (limit > kFarAbove * peak) continue;
      top_ = std::max(top_, limit);
      drawn_ = std::max(drawn_, limit);
    }
  }

  void add_curve(const Curve& curve, std::string_view colour, const std::string& title) {
    const std::string name = fmt::format("$curve{}", plots_.size());
    fmt::format_to(std::back_inserter(data_), "{} << EOD\n", name);
    for (const auto& [time, value] : curve) {
      fmt::format_to(std::back_inserter(data_), "{:.9g} {:.5g}\n", time, value);
    }
    data_ += "EOD\n";
    plots_.push_back(
        fmt::format("{} with lines linewidth 1.2 linecolor '{}{}' title '{}'", name, kTranslucent, colour, title));
  }

  // A dashed line at `value`, if it lies in the picture.
  void add_limit(double value, std::string_view colour) {
    if (std::abs(value) > drawn_) return;
    plots_.push_back(fmt::format("{} with lines dashtype 2 linewidth 1.5 linecolor '#{}' notitle", value, colour));
  }

  // `row` counts from the top; `symmetric`: the values have either sign.
  std::string script(int row, const PlotData& data, std::string_view label, bool symmetric) const {
    constexpr double kTop = 0.9, kPanelHeight = 0.24, kStep = 0.285;
    const double top = kTop - row * kStep;
    const bool bottom_row = row == 2;
    return data_ + fmt::format(
                       "set lmargin at screen 0.545; set rmargin at screen 0.985\n"
                       "set tmargin at screen {}; set bmargin at screen {}\n"
                       "set xrange [{:.9g}:{:.9g}]; set yrange [{:.6g}:{:.6g}]\n"
                       "set ylabel '{}'; set xlabel '{}'; set format x '{}'\n"
                       "set key at graph 1, graph 1.16 right top horizontal samplen 1.5 textcolor '#202020'\n"
                       "plot {}\n",
                       top, top - kPanelHeight, data.from_s, data.to_s, symmetric ? -1.08 * top_ : 0, 1.08 * top_,
                       label, bottom_row ? "time, s" : "", bottom_row ? "% h" : "", fmt::join(plots_, ", "));
  }

 private:
  double top_ = 0;    // largest value in the picture
  double drawn_ = 0;  // largest limit that is drawn
  std::string data_;
  std::vector<std::string> plots_;
};

std::string speed_panel(const PlotData& data, const std::vector<double>& limits) {
  Diagram diagram({data.speed}, limits);
  std::vector<std::string> named;
  for (std::size_t axis = 0; axis < limits.size(); ++axis) {
    named.push_back(fmt::format("{} {:.10g}", client::kAxisNames.at(axis), limits[axis]));
    diagram.add_limit(limits[axis], kAxisColours.at(axis));
  }
  diagram.add_curve(data.speed, "202020", fmt::format("along the path (axis limits {})", fmt::join(named, ", ")));
  return diagram.script(0, data, "speed, mm/s", false);
}

// Acceleration or jerk: a curve for each axis, and its limits on both sides.
std::string axes_panel(int row, const PlotData& data, std::string_view label, const std::vector<Curve>& curves,
                       const std::vector<double>& limits) {
  Diagram diagram(curves, limits);
  for (std::size_t axis = 0; axis < curves.size(); ++axis) {
    diagram.add_curve(curves[axis], kAxisColours.at(axis),
                      fmt::format("{} (limit {:.10g})", client::kAxisNames.at(axis), limits[axis]));
    diagram.add_limit(limits[axis], kAxisColours.at(axis));
    diagram.add_limit(-limits[axis], kAxisColours.at(axis));
  }
  return diagram.script(row, data, label, true);
}

}  // namespace

std::string plot_script(const PlotData& data, const client::Plan& plan, const std::string& title,
                        const std::string& picture, PictureFormat format) {
  const client::Machine& machine = plan.options.machine;
  return setup(title, picture, format) + path_panel(data) + speed_panel(data, machine.velocity_mm_s) +
         axes_panel(1, data, "acceleration, mm/s²", data.acceleration, machine.acceleration_mm_s2) +
         axes_panel(2, data, "jerk, mm/s³", data.jerk, machine.jerk_mm_s3) + "unset multiplot\n";
}

}  // namespace kcs::cli
