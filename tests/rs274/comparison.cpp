#include "tests/rs274/comparison.h"

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>
#include <sstream>

namespace kcs::test {
namespace {

using planning::Segment;
using planning::Vector;
using std::numbers::pi;

constexpr double kSame = 1e-6;  // mm

std::string text_of(const Vector& point) {
  std::ostringstream text;
  text.precision(9);
  text << point.transpose();
  return text.str();
}

class Follower {
 public:
  explicit Follower(const planning::Toolpath& path) : path_(path), at_(path.start) {}

  // What is wrong on the next segments as the path of `move`; empty if nothing is.
  std::string follow(const Move& move) {
    skip_pauses();
    return move.turns == 0 ? follow_line(move) : follow_arc(move);
  }

  // Nothing but dwells and switches is left.
  bool has_ended() {
    skip_pauses();
    return at_end();
  }

 private:
  bool at_end() const { return next_ == path_.segments.size(); }

  // What happens at the start of a path, and one switch after the other, has no place but in segments of no length.
  void skip_pauses() {
    while (!at_end() && is_pause(path_.segments[next_])) ++next_;
  }
  bool is_pause(const Segment& segment) const {
    return segment.end == at_ && (segment.dwell > 0 || segment.marker.kind != planning::MarkerKind::kNone);
  }

  // Goes to the end of the next segment.
  std::string take(const Move& move) {
    if (at_end()) return "the path has ended";
    const Segment& segment = path_.segments[next_++];
    at_ = segment.end;
    if (segment.line == move.line) return {};
    return "the path's move comes from line " + std::to_string(segment.line);
  }

  std::string follow_line(const Move& move) {
    const bool is_none = (move.end - at_).norm() < kSame;
    // A path has no segments of no length, but for those of rounding.
    if (is_none && (at_end() || (path_.segments[next_].end - move.end).norm() > kSame)) return {};
    if (std::string wrong = take(move); !wrong.empty()) return wrong;
    return (at_ - move.end).norm() < kSame ? "" : "the path's move ends at " + text_of(at_);
  }

  std::string follow_arc(const Move& move) {
    const Vector start = at_;
    const double sign = move.turns > 0 ? 1 : -1;
    const double start_radius = radius(start, move);
    double sweep = sign * angle(start, move.end, move);
    if (sweep < 0) sweep += 2 * pi;
    if (flat(start - move.end, move).norm() < kSame / 10) sweep = 2 * pi;
    sweep += 2 * pi * (std::abs(move.turns) - 1);
    double turned = 0;
    while ((sweep - turned) * start_radius > kSame / 10) {
      const Vector before = at_;
      if (std::string wrong = take(move); !wrong.empty()) return wrong;
      turned += sign * angle(before, at_, move);
      const double share = turned / sweep;
      const double off_radius = radius(at_, move) - std::lerp(start_radius, radius(move.end, move), share);
      const double off_height = at_[move.normal] - std::lerp(start[move.normal], move.end[move.normal], share);
      if (std::hypot(off_radius, off_height) > kSame) return "the path leaves the arc at " + text_of(at_);
    }
    return (at_ - move.end).norm() < kSame ? "" : "the path's arc ends at " + text_of(at_);
  }

  static Vector flat(Vector vector, const Move& move) {
    vector[move.normal] = 0;
    return vector;
  }
  static double radius(const Vector& point, const Move& move) { return flat(point - move.centre, move).norm(); }

  // From one point to the other about the centre, −π to π, > 0 counterclockwise.
  static double angle(const Vector& from, const Vector& to, const Move& move) {
    const Vector a = flat(from - move.centre, move);
    const Vector b = flat(to - move.centre, move);
    return std::atan2(a.cross(b)[move.normal], a.dot(b));
  }

  const planning::Toolpath& path_;
  std::size_t next_ = 0;
  Vector at_;
};

}  // namespace

std::string difference(const planning::Toolpath& path, const std::vector<Move>& moves) {
  Follower follower(path);
  for (const Move& move : moves) {
    const std::string wrong = follower.follow(move);
    if (wrong.empty()) continue;
    return "line " + std::to_string(move.line) + ": the reference " + (move.turns == 0 ? "moves" : "turns") + " to " +
           text_of(move.end) + ", " + wrong;
  }
  return follower.has_ended() ? "" : "the path goes on where the reference has ended";
}

}  // namespace kcs::test
