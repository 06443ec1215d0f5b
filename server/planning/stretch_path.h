// The part of a path that a stretch replaces, by its arc length.
#pragma once

#include <cstddef>
#include <span>
#include <stop_token>
#include <utility>
#include <vector>

#include "server/motion/course.h"
#include "server/planning/leg.h"
#include "server/planning/options.h"

namespace kcs::planning {

// Legs that follow each other, without the beginning of the first and the end of the last one, perhaps.
struct LegRange {
  std::size_t first = 0, last = 0;
  double skipped = 0;  // of the first leg, mm
  double left = 0;     // of the last leg, mm
};

// A place on the path, and how far something is away from it.
struct Projection {
  std::size_t leg = 0;
  double way = 0;       // mm
  double distance = 0;  // mm
};

class StretchPath {
 public:
  // `path` must outlive this.
  StretchPath(const LegPath& path, const LegRange& range, const PlanOptions& options);

  std::span<const Leg> legs() const { return legs_; }
  double length() const { return ends_.back(); }   // mm
  double tolerance() const { return tolerance_; }  // the least one, mm

  // The way from the start of the stretch to the start of a leg, mm; leg ≤ legs().size().
  double way(std::size_t leg) const { return ends_[leg]; }

  // The way to where a leg begins on the whole path, mm; less than zero if the stretch begins inside it.
  double start_of(std::size_t leg) const { return leg == 0 ? -skipped_ : ends_[leg]; }

  // How near the motion must come to the end of a leg that is not the last, mm.
  double reach(std::size_t leg) const { return reaches_[leg]; }

  // Whether a motion that keeps the tolerance may come too little near to the end of a leg.
  bool may_be_missed(std::size_t leg) const { return may_be_missed_[leg]; }

  // A distance as a share of the tolerance of the leg.
  double share_of_tolerance(const Projection& place) const { return place.distance * lines_[place.leg].per_tolerance; }

  // The point at a way on a leg; beyond the ends of the stretch it goes on straight. From origin().
  Vector at(std::size_t leg, double way) const {
    return lines_[leg].start + (way - ends_[leg]) * lines_[leg].direction;
  }

  // The leg at a way; where two meet, the first. Logarithmic in the number of legs.
  std::size_t leg_at(double way) const;
  // The same; searches from a leg near it.
  std::size_t leg_at(double way, std::size_t near) const;

  // The place nearest to a point, from origin(), among those that are nearer and nearer from a leg on.
  Projection project(const Vector& point, std::size_t near) const;

  // The first and the last leg that a motion may follow between two ways, mm. Searches from a leg near them.
  std::pair<std::size_t, std::size_t> legs_between(double from, double to, std::size_t near = 0) const;

  // The least feed of the legs that a motion may follow between two ways, mm/s.
  double feed_between(double from, double to) const;

  // Its start, the corners inside it and its end, from origin(), mm.
  const std::vector<Vector>& corners() const { return corners_; }
  // Its legs, whole, from origin().
  std::span<const motion::Piece> pieces() const { return pieces_; }
  const Vector& origin() const { return legs_.front().start; }

 private:
  // What a projection asks for again and again, together.
  struct Line {
    Vector start, direction;
    double length, per_tolerance;  // mm, 1/mm
    // Squares of the tangents of half the largest turns from the legs before it, and to those after it, which are not
    // beyond a small detour.
    double turn_before = 0, turn_after = 0;
  };

  // Legs of the same feed, one after the other.
  struct FeedRun {
    double end;   // way, mm
    double feed;  // mm/s
  };

  void find_turns(const std::stop_token& stop);
  void find_what_may_be_missed(const std::stop_token& stop);
  double square_distance(const Vector& point, std::size_t leg, double& along) const;

  std::span<const Leg> legs_;
  double skipped_;
  std::vector<double> ends_;  // from zero; entry i + 1 is where leg i ends
  std::vector<Vector> corners_;
  std::vector<Line> lines_;  // the parts of the legs that belong to the stretch
  std::vector<double> reaches_;
  std::vector<bool> may_be_missed_;
  std::vector<motion::Piece> pieces_;
  double tolerance_;
  std::vector<FeedRun> feeds_;
};

}  // namespace kcs::planning
