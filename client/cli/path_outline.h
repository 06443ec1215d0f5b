// The path of a tool with its speed, thinned to what a picture can show.
#pragma once

#include <cstddef>
#include <vector>

#include "client/cli/outline_point.h"

namespace kcs::cli {

// A line that is drawn without lifting the pen. Between two of its points the speed changes so little that one colour
// does for the piece.
using Stroke = std::vector<OutlinePoint>;

// Gathers the points of a path of any length, dropping those whose absence nobody could see.
class PathOutline {
 public:
  void add(const OutlinePoint& point);

  // The path as strokes of at most `most_pieces` pieces together. If that does not do (a program with many layers, one
  // upon the other), pieces are left out where others have been drawn already.
  std::vector<Stroke> strokes(std::size_t most_pieces) const;

 private:
  std::vector<OutlinePoint> points_;
  std::size_t room_ = 1'000'000;  // number of points at which they are thinned out
};

}  // namespace kcs::cli
