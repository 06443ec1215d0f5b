#include "server/motion/route.h"

#include <spdlog/fmt/fmt.h>

#include <algorithm>

#include "server/motion/contour.h"
#include "server/motion/going_back.h"

namespace kcs::motion {
namespace {

// As near as this is on the point, mm, beside what coordinates can tell.
constexpr double kOnPoint = 1e-9;

}  // namespace

bool Route::goes_on_with(const SegmentRange& pieces) const {
  if (!begun_) return pieces.first == 0;
  return pieces.first >= previous_.first && pieces.last >= previous_.last && pieces.first <= previous_.last + 1;
}

std::string Route::follow(const Phase& phase, const State& end, const Course& course, const SegmentRange& pieces,
                          std::span<const double> mitres) {
  std::string fault = leave_behind(course, pieces.first);
  begun_ = true;
  previous_ = pieces;
  joints_.resize(pieces.last + 1 - first_);
  if (fault.empty()) {
    const double back = speed_back(phase, end, course.part(pieces), slowest_);
    if (back > 0) fault = fmt::format("the tool goes back on its path at {} mm/s", back);
  }
  see_joints(phase, end, course, pieces, mitres);
  return fault;
}

// A phase that follows the pieces from `first` on meets their joints, and the one where `first` begins.
std::string Route::leave_behind(const Course& course, std::uint32_t first) {
  std::string fault;
  for (; first_ + 1 < first; ++first_) {
    if (fault.empty()) fault = judge(course, first_);
    joints_.pop_front();
  }
  return fault;
}

void Route::see_joints(const Phase& phase, const State& end, const Course& course, const SegmentRange& pieces,
                       std::span<const double> mitres) {
  const double standing = phase.rests() ? phase.duration : 0;
  if (pieces.first > 0) meet(pieces.first - 1, course, phase.start, standing);
  meet(pieces.last, course, end, standing);
  const Curve curve = Curve::between(phase.start, end, phase.duration);
  for (std::uint32_t index = pieces.first; index < pieces.last; ++index) {
    Joint& seen = joint(index);
    if (seen.reached) continue;
    const Piece& piece = course.piece(index);
    const double near = piece.reach + kOnPoint + piece.rounding;
    const Vector passing = phase.at(mitres[index - pieces.first]).position;
    seen.reached =
        (passing - piece.line.to()).squaredNorm() <= near * near || comes_within(curve, piece.line.to(), near);
  }
}

// The motion begins or ends its way along a piece in `state`, or stands there.
void Route::meet(std::uint32_t index, const Course& course, const State& state, double standing) {
  const Piece& piece = course.piece(index);
  Joint& seen = joint(index);
  const double distance = (state.position - piece.line.to()).norm(), on_point = kOnPoint + piece.rounding;
  if (distance <= piece.reach + on_point) seen.reached = true;
  if (distance <= on_point && state.velocity.norm() <= slowest_) seen.rested = std::max(seen.rested, 0.0) + standing;
}

std::string Route::judge(const Course& course, std::uint32_t index) const {
  const Piece& piece = course.piece(index);
  const Joint& seen = joints_[index - first_];
  const Vector& at = piece.line.to();
  if (!seen.reached) {
    return fmt::format("the tool does not come within {} mm of the corner at ({}, {}, {})", piece.reach, at.x(), at.y(),
                       at.z());
  }
  if (piece.rest >= 0 && !(seen.rested >= piece.rest * (1 - 1e-12))) {
    return fmt::format("the tool does not rest at ({}, {}, {}) as long as it should", at.x(), at.y(), at.z());
  }
  return "";
}

std::string Route::finish(const Course& course) const {
  if (!begun_) {
    const auto pieces = course.part({0, course.pieces() - 1});
    const bool moves =
        std::any_of(pieces.begin(), pieces.end(), [](const Piece& p) { return p.line.from() != p.line.to(); });
    return moves ? "nothing of the path is travelled" : "";
  }
  if (previous_.last + 1 != course.pieces()) return "the end of the path is left out";
  std::string fault;
  for (std::uint32_t i = first_; i < course.pieces() && fault.empty(); ++i) fault = judge(course, i);
  return fault;
}

}  // namespace kcs::motion
