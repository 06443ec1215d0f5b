#include "server/planning/density.h"

#include "server/planning/sharp_turns.h"

namespace kcs::planning {
namespace {

// So many points for each sharp corner, or for each leg, are few; so many for each leg are many.
constexpr double kCrowd = 12, kDense = 12, kSparse = 60;

// Fewer points are neither dense nor sparse: they cost little, and a short piece with rests at its ends wants every
// one.
constexpr std::size_t kFewest = 150;

std::size_t count_legs(const StretchPath& path, double from, double to) {
  return path.leg_at(to) - path.leg_at(from) + 1;
}

}  // namespace

bool is_crowded(const StretchPath& path, double from, double to, std::size_t points) {
  std::size_t sharp = 0;
  const std::size_t last = path.leg_at(to);
  SharpTurns turns;
  for (std::size_t leg = path.leg_at(from); leg <= last; ++leg) sharp += turns.before(path.legs()[leg]) ? 1 : 0;
  return kCrowd * static_cast<double>(sharp) > static_cast<double>(points);
}

bool is_dense(const StretchPath& path, double from, double to, std::size_t points) {
  if (points < kFewest) return false;
  const auto legs = static_cast<double>(count_legs(path, from, to));
  return kDense * legs > static_cast<double>(points) && !is_crowded(path, from, to, points);
}

bool is_sparse(const StretchPath& path, double from, double to, std::size_t points) {
  const auto legs = static_cast<double>(count_legs(path, from, to));
  return points >= kFewest && kSparse * legs < static_cast<double>(points);
}

}  // namespace kcs::planning
