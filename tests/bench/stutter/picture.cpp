#include "tests/bench/stutter/picture.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

namespace kcs::bench {
namespace {

constexpr double kSurroundings = 5;  // mm on either side of the deepest dip

template <class... Values>
void add(std::string& script, fmt::format_string<Values...> format, Values&&... values) {
  fmt::format_to(std::back_inserter(script), format, std::forward<Values>(values)...);
}

// Hundreds of thousands of samples, as many as the picture has columns: slowest and fastest in each.
std::string whole(std::span<const SpeedSample> samples) {
  constexpr std::size_t kColumns = 3000;
  const double width = samples.back().length / kColumns;
  std::string script = "$whole << EOD\n";
  for (auto from = samples.begin(); from != samples.end();) {
    const double end = from->length + width;
    const auto to = std::find_if(from + 1, samples.end(), [&](const SpeedSample& one) { return one.length > end; });
    const auto [low, high] = std::minmax_element(
        from, to, [](const SpeedSample& one, const SpeedSample& other) { return one.speed < other.speed; });
    add(script, "{:.9g} {:.5g} {:.5g}\n", from->length, low->speed, high->speed);
    from = to;
  }
  return script + "EOD\n";
}

std::string close_up(std::span<const SpeedSample> samples, double middle) {
  std::string speeds = "$close << EOD\n", joints = "$joints << EOD\n";
  std::size_t segment = 0;
  for (const SpeedSample& one : samples) {
    if (std::abs(one.length - middle) > kSurroundings) continue;
    add(speeds, "{:.9g} {:.6g}\n", one.length, one.speed);
    if (one.segment != segment) add(joints, "{:.9g} 0\n", one.length);
    segment = one.segment;
  }
  return speeds + "EOD\n" + joints + "EOD\n";
}

std::string smooth(std::span<const SpeedSample> samples, std::span<const Stretch> stretches) {
  std::string script = "$smooth << EOD\n0 NaN\n";
  bool inside = false;
  for (const SpeedSample& one : samples) {
    const bool smooth = stretches[one.segment].smooth();
    if (smooth != inside) add(script, "{:.9g} 0\n{}", one.length, inside ? "\n" : "");  // an empty line lifts the pen
    inside = smooth;
  }
  if (inside) add(script, "{:.9g} 0\n", samples.back().length);
  return script + "EOD\n";
}

std::string marks(std::span<const Dip> dips, double noticeable) {
  std::string script = "$dips << EOD\n0 NaN\n";
  for (const Dip& dip : dips) {
    if (dip.depth > noticeable) add(script, "{:.9g} {:.6g}\n", dip.at.length, dip.at.speed);
  }
  return script + "EOD\n";
}

}  // namespace

std::string picture_script(const std::string& title, const std::string& picture, std::span<const SpeedSample> samples,
                           std::span<const Stretch> stretches, std::span<const Dip> dips, double noticeable) {
  const auto deepest = std::max_element(dips.begin(), dips.end(),
                                        [](const Dip& one, const Dip& other) { return one.depth < other.depth; });
  const double middle = deepest == dips.end() ? samples.back().length / 2 : deepest->at.length;
  return whole(samples) + close_up(samples, middle) + smooth(samples, stretches) + marks(dips, noticeable) +
         fmt::format(
             "set terminal svg size 1500,900 dynamic font 'DejaVu Sans,14' background 'white' noenhanced\n"
             "set output '{}'\n"
             "set multiplot layout 2,1 title \"{}\"\n"
             "set border 3 linecolor '#606060'; set tics nomirror out\n"
             "set grid linecolor '#e4e4e4'; set clip two\n"
             "set ylabel 'speed along the path, mm/s'; set yrange [0:*]; set offsets 0, 0, graph 0.05, 0\n"
             "set key outside top right horizontal samplen 2\n"
             "dips = \"with points pointtype 7 pointsize 0.7 linecolor '#D55E00' title 'dips deeper than {:g} %'\"\n"
             "smooth = \"with lines linewidth 6 linecolor '#009E73' title 'smooth curve'\"\n"
             "set xlabel 'path length, mm: the whole program'; set xrange [0:{:.9g}]\n"
             "plot $whole using 1:2:3 with filledcurves linecolor '#0072B2' title 'slowest to fastest', \\\n"
             "  $whole using 1:3 with lines linecolor '#0072B2' notitle, $smooth @smooth, $dips @dips\n"
             "set xlabel 'path length, mm: around the deepest dip; ticks at the foot: segments'\n"
             "set xrange [{:.9g}:{:.9g}]\n"
             "plot $close with lines linewidth 2 linecolor '#0072B2' title 'speed', $smooth @smooth, \\\n"
             "  $joints with points pointtype 1 pointsize 0.6 linecolor '#202020' notitle, $dips @dips\n"
             "unset multiplot\n",
             picture, title, 100 * noticeable, samples.back().length, std::max(0.0, middle - kSurroundings),
             std::min(samples.back().length, middle + kSurroundings));
}

}  // namespace kcs::bench
