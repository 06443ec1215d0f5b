#include "server/motion/route.h"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <limits>

#include "server/motion/contour.h"

namespace kcs::motion {
namespace {

// As near as this is on the point, mm, beside what coordinates can tell.
constexpr double kOnPoint = 1e-9;

bool stands(const Phase& phase) {
  return phase.start.velocity.isZero(0) && phase.start.acceleration.isZero(0) && phase.jerk.isZero(0);
}

}  // namespace

Route::Route(const Course& course, double slowest)
    : course_(course),
      slowest_(slowest),
      joints_(course.pieces().size() - 1, {std::numeric_limits<double>::infinity()}) {}

std::string Route::follow(const Phase& phase, const SegmentRange& pieces) {
  std::string fault = check_order(pieces);
  if (fault.empty() && pieces.first == pieces.last) fault = check_forward(phase, course_.pieces()[pieces.first]);
  visit_joints(phase, pieces);
  return fault;
}

std::string Route::check_order(const SegmentRange& pieces) {
  const bool in_order =
      begun_ ? pieces.first >= previous_.first && pieces.last >= previous_.last && pieces.first <= previous_.last + 1
             : pieces.first == 0;
  begun_ = true;
  previous_ = pieces;
  return in_order ? "" : "a part of the path is left out or travelled out of order";
}

// Velocity along the piece: a parabola in time, least at an end or where its slope is zero.
std::string Route::check_forward(const Phase& phase, const Piece& piece) const {
  if (piece.from == piece.to) return "";
  const Vector direction = (piece.to - piece.from).normalized();
  const double slope = phase.start.acceleration.dot(direction), bend = phase.jerk.dot(direction);
  double least = std::min(phase.start.velocity.dot(direction), phase.at(phase.duration).velocity.dot(direction));
  if (bend > 0 && slope < 0 && -slope / bend < phase.duration) {
    least = std::min(least, phase.at(-slope / bend).velocity.dot(direction));
  }
  return least >= -slowest_ ? "" : fmt::format("the tool goes back on a straight line at {} mm/s", -least);
}

void Route::visit_joints(const Phase& phase, const SegmentRange& pieces) {
  for (std::size_t joint = pieces.first; joint < pieces.last; ++joint) {
    joints_[joint].nearest = std::min(joints_[joint].nearest, closest_approach(phase, course_.pieces()[joint].to));
  }
  const double standing = stands(phase) ? phase.duration : 0;
  if (pieces.first > 0) pass(pieces.first - 1, phase.start, standing);
  if (pieces.last < joints_.size()) pass(pieces.last, phase.at(phase.duration), standing);
}

void Route::pass(std::size_t joint, const State& state, double standing) {
  const Piece& piece = course_.pieces()[joint];
  const double distance = (state.position - piece.to).norm();
  joints_[joint].nearest = std::min(joints_[joint].nearest, distance);
  if (distance <= kOnPoint + piece.rounding() && state.velocity.norm() <= slowest_) {
    joints_[joint].rested = std::max(joints_[joint].rested, 0.0) + standing;
  }
}

std::string Route::finish() const {
  const auto pieces = course_.pieces();
  if (!begun_) {
    const bool moves = std::any_of(pieces.begin(), pieces.end(), [](const Piece& p) { return p.from != p.to; });
    return moves ? "nothing of the path is travelled" : "";
  }
  if (previous_.last + 1 != pieces.size()) return "the end of the path is left out";
  for (std::size_t i = 0; i < joints_.size(); ++i) {
    const Piece& piece = pieces[i];
    const auto where = [&] { return fmt::format("at ({}, {}, {})", piece.to.x(), piece.to.y(), piece.to.z()); };
    if (!(joints_[i].nearest <= piece.reach + kOnPoint + piece.rounding())) {
      return fmt::format("the corner {} is passed at a distance of {} mm, more than {} mm", where(), joints_[i].nearest,
                         piece.reach);
    }
    if (piece.rest >= 0 && !(joints_[i].rested >= piece.rest * (1 - 1e-12))) {
      return fmt::format("the tool does not rest {} as long as it should", where());
    }
  }
  return "";
}

}  // namespace kcs::motion
