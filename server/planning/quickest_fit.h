// Points at equal steps of time that keep to a path and can be travelled in the least time.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <stop_token>
#include <vector>

#include "server/planning/band_matrix.h"

namespace kcs::planning {

// A convex program: the points of a motion, all but the first and the last three of them free, and the least t with
// which all limits are kept if every step of time may last t^(1/3) times as long. Then jerk may be t times its limit,
// acceleration t^(2/3) times and speed t^(1/3) times; for the latter two the tangents at t = 1 are taken.
// Solved by a primal-dual interior-point method whose first points need not keep anything (Boyd and Vandenberghe,
// Convex Optimization, 11.7; with slacks). What constrains it is added first. Keeps its memory from one to the next.
class QuickestFit {
 public:
  // With which power of the time a limit grows.
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
  // The sum lies in a region. If held points are part of it, it may be as far away as it is, whatever the radius.
  void place(const PointSum& sum, const Region& region);

  // False if it was not solved within a bounded number of rounds. Throws Stopped.
  bool solve(const std::stop_token& stop);

  // To a hundredth of t, and nearly inside.
  std::span<const Vector> points() const { return points_; }
  double t() const { return t_; }

 private:
  // Inequalities f ≤ 0: f + slack is to become zero, slack · multiplier too.
  template <int Size>
  struct Inequalities {
    using Numbers = Eigen::Array<double, Size, 1>;
    Numbers excess = Numbers::Zero();  // f
    Numbers slack = Numbers::Zero(), multiplier = Numbers::Zero();
    Numbers change = Numbers::Zero();  // of the slack, in a step
  };
  struct Box {
    PointSum sum;
    Eigen::Array3d per_limit;
    double per_t;
    Inequalities<3> above = {}, below = {};
  };
  struct Round {
    PointSum sum;
    Region region;
    double per_square, per_t;
    Vector gradient = Vector::Zero();
    Inequalities<1> side = {};

    Vector away(const std::vector<Vector>& points) const;  // from the region's point or line
  };
  // What t has to do with itself, and the right side of t.
  struct Corner {
    double matrix, right;
  };

  bool is_free(const PointSum& sum) const;
  bool is_all_free(const PointSum& sum) const;
  void measure();
  void set_slacks();
  bool step();
  Corner assemble(double target);
  double find_change(const Corner& corner);
  void move(double target, double change_of_t);

  std::vector<Vector> points_, change_, border_, along_border_;
  double t_ = 1;
  std::vector<Box> boxes_;
  std::vector<Round> rounds_;
  BandMatrix matrix_;
  double inequalities_ = 0;
  double gap_ = 0;      // Σ slack · multiplier
  double outside_ = 0;  // the largest f
  double centering_ = 0;
};

}  // namespace kcs::planning
