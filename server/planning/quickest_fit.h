// Points at equal steps of time that keep to a path and can be travelled in the least time.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <stop_token>
#include <vector>

#include "server/planning/band_matrix.h"

namespace kcs::planning {

// A convex program: the points of a motion, all but the first and the last three of them free, and the least share
// "longer" with which all limits are kept if every step of time lasts that many times as long. Then speed may be so
// many times its limit, acceleration the square and jerk the cube; of these the tangents at 1 are taken, which allow
// less. The ends stay where they are and as fast: how their points move with the steps is taken into account. Solved by
// a primal-dual interior-point method whose first points need not keep anything, with Mehrotra's predictor and
// corrector (Nocedal and Wright, Numerical Optimization, 19.3). What constrains it is added first. Keeps its memory
// from one to the next.
class QuickestFit {
 public:
  // With which power of the steps' length a limit grows.
  enum class Kind { kSpeed = 1, kAcceleration = 2, kJerk = 3 };

  // Away from a point or, if there is a direction (a unit vector), from a line: at most this radius, mm.
  struct Region {
    Vector origin = Vector::Zero();  // mm
    Vector direction = Vector::Zero();
    double radius = 0;
  };

  // Begins another one, with these points.
  void begin(std::span<const Vector> points);

  // Each axis of the sum is at most this; +infinity: there is no limit.
  void limit_axes(const PointSum& sum, const Vector& limit, Kind kind);
  // The length of the sum is a speed and at most this.
  void limit_speed(const PointSum& sum, double limit);
  // The sum lies in a region, unless points that are not free are part of it.
  void place(const PointSum& sum, const Region& region);

  // False if it was not solved within a bounded number of rounds. Throws Stopped.
  bool solve(const std::stop_token& stop);

  // To half a percent of the time, and nearly inside. Points that are not free are as they were.
  std::span<const Vector> points() const { return points_; }
  double longer() const { return longer_; }

 private:
  // Inequalities f ≤ 0: f + slack is to become zero, slack · multiplier the target, and that zero at last.
  template <int Size>
  struct Inequalities {
    using Numbers = Eigen::Array<double, Size, 1>;
    Numbers excess = Numbers::Zero();  // f
    Numbers slack = Numbers::Zero(), multiplier = Numbers::Zero(), target = Numbers::Zero();
    Numbers slack_change = Numbers::Zero(), multiplier_change = Numbers::Zero();  // in a step
  };
  struct Box {
    PointSum sum;
    Eigen::Array3d per_limit;
    Eigen::Array3d growth_above, growth_below;  // of what is allowed, with longer steps
    Inequalities<3> above = {}, below = {};
  };
  struct Round {
    PointSum sum;
    Region region;
    double per_square, growth;
    Vector drift;  // of the sum, with longer steps
    Vector gradient = Vector::Zero();
    Inequalities<1> side = {};

    Vector across(const Vector& value) const { return value - value.dot(region.direction) * region.direction; }
  };
  // Up to 1, so that slacks and multipliers stay positive.
  struct Shares {
    double slacks = 1, multipliers = 1;
  };

  template <class Use>
  void for_all_sides(Use use);
  bool is_free(const PointSum& sum) const;
  bool is_all_free(const PointSum& sum) const;
  Vector drift_of(const PointSum& sum) const;
  void measure();
  void set_slacks();
  bool step();
  bool assemble();
  void find_change();
  Shares shares_of_change();
  double gap_after(const Shares& shares);
  void move(const Shares& shares);

  std::vector<Vector> points_;
  // Newton's equations for the points, and what `longer` has to do with them and with itself.
  BandMatrix matrix_;
  std::vector<Vector> border_, along_border_;
  double stiff_ = 0;
  std::vector<Vector> change_;
  double change_of_longer_ = 0;
  std::array<Vector, 6> drift_;  // of the points that are not free, with longer steps
  double longer_ = 1;
  std::vector<Box> boxes_;
  std::vector<Round> rounds_;
  double inequalities_ = 0;
  double gap_ = 0;      // Σ slack · multiplier
  double outside_ = 0;  // the largest f
};

}  // namespace kcs::planning
