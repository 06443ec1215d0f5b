#include "client/cli/pixel_grid.h"

#include <algorithm>
#include <cmath>

namespace kcs::cli {
namespace {

// A line is worth drawing if this share of its pixels is new.
constexpr double kNewShare = 0.34;
// So that a path without any length still has a picture.
constexpr double kSmallestSize = 1e-6;

}  // namespace

Extent::Extent(const std::vector<OutlinePoint>& points) {
  if (points.empty()) return;
  double right = points.front().x, top = points.front().y;
  left_ = right;
  bottom_ = top;
  for (const OutlinePoint& point : points) {
    left_ = std::min(left_, point.x);
    right = std::max(right, point.x);
    bottom_ = std::min(bottom_, point.y);
    top = std::max(top, point.y);
  }
  width_ = std::max(right - left_, kSmallestSize);
  height_ = std::max(top - bottom_, kSmallestSize);
}

std::size_t PixelGrid::pixel_at(double x, double y) const {
  const auto index = [this](double offset) {
    return std::min(side_ - 1, static_cast<std::size_t>(offset / extent_.size() * static_cast<double>(side_)));
  };
  return index(y - extent_.bottom()) * side_ + index(x - extent_.left());
}

bool PixelGrid::paint(const OutlinePoint& from, const OutlinePoint& to) {
  const double pixel = extent_.size() / static_cast<double>(side_);
  const double length = std::max(std::abs(to.x - from.x), std::abs(to.y - from.y));
  const int steps = 1 + static_cast<int>(length / pixel);
  int fresh = 0;
  for (int step = 1; step <= steps; ++step) {
    const double share = static_cast<double>(step) / steps;
    const std::size_t index = pixel_at(from.x + share * (to.x - from.x), from.y + share * (to.y - from.y));
    if (!painted_[index]) ++fresh;
    painted_[index] = true;
  }
  return fresh >= kNewShare * steps;
}

}  // namespace kcs::cli
