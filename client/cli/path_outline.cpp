#include "client/cli/path_outline.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "client/cli/pixel_grid.h"

namespace kcs::cli {
namespace {

// What nobody sees, as a share of the picture's width: a quarter of a pixel.
constexpr double kInvisible = 4e-4;
// One piece has one colour. This change of speed, as a share of the top speed, shows as a different one.
constexpr double kColourStep = 0.04;
// Pixels on a side of the picture; less if the path has too many pieces.
constexpr std::size_t kFinestGrid = 512;
constexpr std::size_t kCoarsestGrid = 8;

double top_speed_of(const std::vector<OutlinePoint>& points) {
  double top_speed = 0;
  for (const OutlinePoint& point : points) top_speed = std::max(top_speed, point.speed);
  return top_speed;
}

// How much is missed if `point` is not drawn on the line from `a` to `b`, mm.
double miss(const OutlinePoint& point, const OutlinePoint& a, const OutlinePoint& b, double mm_per_speed) {
  const double dx = b.x - a.x, dy = b.y - a.y, ds = (b.speed - a.speed) * mm_per_speed;
  const double px = point.x - a.x, py = point.y - a.y, ps = (point.speed - a.speed) * mm_per_speed;
  const double square = dx * dx + dy * dy + ds * ds;
  const double along = square > 0 ? std::clamp((px * dx + py * dy + ps * ds) / square, 0.0, 1.0) : 0.0;
  return std::hypot(px - along * dx, py - along * dy, ps - along * ds);
}

// Drops points that nobody misses, every second one at most in a pass, until a pass gains next to nothing: about linear
// in the number of points, however the path winds.
std::vector<OutlinePoint> thin(std::vector<OutlinePoint> points) {
  const double tolerance = kInvisible * Extent(points).size();
  const double top_speed = top_speed_of(points);
  const double mm_per_speed = top_speed > 0 ? tolerance / (kColourStep / 2 * top_speed) : 0;
  std::size_t dropped = points.size();
  while (dropped > points.size() / 64) {
    std::size_t kept = 0;
    for (std::size_t i = 0; i < points.size(); ++i) {
      const bool inner = kept > 0 && i + 1 < points.size();
      if (inner && miss(points[i], points[kept - 1], points[i + 1], mm_per_speed) <= tolerance) ++i;
      points[kept++] = points[i];
    }
    dropped = points.size() - kept;
    points.resize(kept);
  }
  return points;
}

// Adds the line from `from` to `to`, in pieces of one colour.
void draw(Stroke& stroke, const OutlinePoint& from, const OutlinePoint& to, double top_speed) {
  const double change = top_speed > 0 ? std::abs(to.speed - from.speed) / top_speed : 0;
  const int parts = std::max(1, static_cast<int>(std::ceil(change / kColourStep)));
  if (stroke.empty()) stroke.push_back(from);
  for (int part = 1; part <= parts; ++part) {
    const double share = static_cast<double>(part) / parts;
    stroke.push_back({from.x + share * (to.x - from.x), from.y + share * (to.y - from.y),
                      from.speed + share * (to.speed - from.speed)});
  }
}

// Draws the lines that `is_wanted`, with a new stroke after each that is not.
template <typename IsWanted>
std::vector<Stroke> draw_lines(const std::vector<OutlinePoint>& points, double top_speed, const IsWanted& is_wanted) {
  std::vector<Stroke> strokes(1);
  for (std::size_t i = 1; i < points.size(); ++i) {
    if (is_wanted(points[i - 1], points[i])) {
      draw(strokes.back(), points[i - 1], points[i], top_speed);
    } else if (!strokes.back().empty()) {
      strokes.emplace_back();
    }
  }
  if (strokes.back().empty()) strokes.pop_back();
  return strokes;
}

std::size_t pieces_of(const std::vector<Stroke>& strokes) {
  std::size_t pieces = 0;
  for (const Stroke& stroke : strokes) pieces += stroke.size() - 1;
  return pieces;
}

}  // namespace

void PathOutline::add(const OutlinePoint& point) {
  points_.push_back(point);
  if (points_.size() < room_) return;
  points_ = thin(std::move(points_));
  room_ = std::max(room_, 2 * points_.size());
}

std::vector<Stroke> PathOutline::strokes(std::size_t most_pieces) const {
  const std::vector<OutlinePoint> points = thin(points_);
  const double top_speed = top_speed_of(points);
  std::vector<Stroke> strokes = draw_lines(points, top_speed, [](const auto&, const auto&) { return true; });
  for (std::size_t side = kFinestGrid; side >= kCoarsestGrid && pieces_of(strokes) > most_pieces; side /= 2) {
    PixelGrid grid(Extent(points), side);
    strokes = draw_lines(points, top_speed,
                         [&grid](const OutlinePoint& from, const OutlinePoint& to) { return grid.paint(from, to); });
  }
  return strokes;
}

}  // namespace kcs::cli
