#include "tests/property/long_case.h"

#include <algorithm>

#include "tests/property/dense_case.h"
#include "tests/property/random.h"

namespace kcs::test {
namespace {

constexpr std::uint64_t kMostPieces = 4;
constexpr double kLongest = 200;  // mm, of a segment: nobody waits for a longer one

}  // namespace

Case long_case(std::uint64_t seed) {
  Random random(seed);
  Case result = dense_case(random.bits());
  const std::size_t axes = result.options.limits.axes;
  const std::uint64_t pieces = 1 + random.bits() % kMostPieces;
  for (std::uint64_t i = 0; i < pieces; ++i) {
    const std::uint64_t piece_seed = random.bits();
    const Case piece = random.chance(0.7) ? dense_case(piece_seed) : random_case(piece_seed);
    for (std::size_t k = 0; k < piece.path.segments.size(); ++k) {
      planning::Segment segment = piece.path.segments[k];
      planning::Vector step = segment.end - piece.path.start_of(k);
      for (std::size_t axis = axes; axis < 3; ++axis) step[static_cast<Eigen::Index>(axis)] = 0;
      step *= std::min(1.0, kLongest / std::max(kLongest, step.norm()));
      segment.end = result.path.segments.back().end + step;
      segment.line = static_cast<std::uint32_t>(result.path.segments.size() + 1);
      result.path.segments.push_back(segment);
    }
  }
  return result;
}

}  // namespace kcs::test
