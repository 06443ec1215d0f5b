#include "server/motion/going_back.h"

#include <algorithm>
#include <limits>
#include <vector>

#include "server/motion/polynomial.h"

namespace kcs::motion {
namespace {

// The least velocity along a direction: a parabola in time, least at an end or where its slope is zero.
double least_advance(const Phase& phase, const State& end, const Vector& direction) {
  const double slope = phase.start.acceleration.dot(direction), bend = phase.jerk.dot(direction);
  double least = std::min(phase.start.velocity.dot(direction), end.velocity.dot(direction));
  if (bend > 0 && slope < 0 && -slope / bend < phase.duration) {
    least = std::min(least, phase.at(-slope / bend).velocity.dot(direction));
  }
  return least;
}

}  // namespace

double speed_back(const Phase& phase, const State& end, std::span<const Piece> pieces, double slowest) {
  const auto never_against = [&](const Piece& piece) {
    return least_advance(phase, end, piece.line.direction()) >= -slowest;
  };
  if (std::any_of(pieces.begin(), pieces.end(), never_against)) return 0;
  std::vector<double> times{0, phase.duration};  // between which it goes along each piece or against it
  for (const Piece& piece : pieces) {
    const Vector& along = piece.line.direction();
    const Roots changes = sign_changes(
        {phase.start.velocity.dot(along) + slowest, phase.start.acceleration.dot(along), phase.jerk.dot(along) / 2, 0},
        phase.duration);
    times.insert(times.end(), changes.begin(), changes.end());
  }
  std::sort(times.begin(), times.end());
  double fastest = 0;
  for (std::size_t i = 0; i + 1 < times.size(); ++i) {
    const Vector velocity = phase.at((times[i] + times[i + 1]) / 2).velocity;
    double advance = -std::numeric_limits<double>::infinity();
    for (const Piece& piece : pieces) advance = std::max(advance, velocity.dot(piece.line.direction()));
    if (advance < -slowest) fastest = std::max(fastest, -advance);
  }
  return fastest;
}

}  // namespace kcs::motion
