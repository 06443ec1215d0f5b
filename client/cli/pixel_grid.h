// Which parts of a picture have been drawn on.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "client/cli/outline_point.h"

namespace kcs::cli {

// The smallest upright rectangle around some points, mm.
class Extent {
 public:
  explicit Extent(const std::vector<OutlinePoint>& points);

  double left() const { return left_; }
  double bottom() const { return bottom_; }
  double width() const { return width_; }
  double height() const { return height_; }
  double size() const { return std::max(width_, height_); }  // > 0

 private:
  double left_ = 0;
  double bottom_ = 0;
  double width_ = 1;
  double height_ = 1;
};

class PixelGrid {
 public:
  // `side`: number of pixels on a side.
  PixelGrid(const Extent& extent, std::size_t side) : extent_(extent), side_(side), painted_(side * side) {}

  // Paints the pixels under a line. False if most of them were painted before, so that the line would hardly be seen.
  bool paint(const OutlinePoint& from, const OutlinePoint& to);

 private:
  std::size_t pixel_at(double x, double y) const;

  Extent extent_;
  std::size_t side_;
  std::vector<bool> painted_;
};

}  // namespace kcs::cli
