// Tool paths of any length, of the kinds that matter.
#pragma once

#include <array>
#include <cstddef>

#include "server/planning/options.h"
#include "server/planning/toolpath.h"

namespace kcs::bench {

inline constexpr double kFeed = 100;           // mm/s
inline constexpr double kTolerance = 0.01;     // mm, contour error
inline constexpr double kAcceleration = 2000;  // mm/s², of every axis
inline constexpr double kJerk = 1e5;           // mm/s³, of every axis

planning::Toolpath circle(std::size_t segments);  // round and round, r = 10 mm, in chords of 0.1 mm
planning::Toolpath spiral(std::size_t segments);  // outwards, in chords of 0.3 mm, every point off by up to 1 µm
planning::Toolpath relief(std::size_t segments);  // passes to and fro over hills, in chords of 0.2 mm
planning::Toolpath zigzag(std::size_t segments);  // lines of 20 mm that meet at 30°

struct PathKind {
  const char* name;
  planning::Toolpath (*make)(std::size_t segments);
};
inline constexpr std::array kPathKinds = {PathKind{"circle", circle}, PathKind{"spiral", spiral},
                                          PathKind{"relief", relief}, PathKind{"zigzag", zigzag}};

}  // namespace kcs::bench
