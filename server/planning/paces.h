// How much longer or shorter the steps of time of a smooth motion should become.
#pragma once

#include <cstddef>
#include <vector>

#include "server/planning/motion_shares.h"

namespace kcs::planning {

// A pace for each step: how many of the old steps it should take. Keeps its memory from one round to the next.
class Paces {
 public:
  // Every step longer or shorter as what it is part of asks for, smoothed over its neighbours; shorter only if the
  // search is not finishing. While it is, also what is too far away from the path takes longer. What is urgent,
  // and what is spare, gets all that it asks for at once, not half of it.
  void set(const MotionShares& shares, const SearchMode& mode);

  // Makes every run of longer steps longer by whole steps, or not at all if it asks for less than `least` of one more;
  // none may be shorter. Where corners are crowded, jerk changes from one limit to the other at every bend, and each
  // bend has found its steps of time: shifted by a part of one, all of them would have to be found again.
  void round(double least);

  double total() const;
  const std::vector<double>& values() const { return paces_; }

  // Where the points at equal new times are among the old ones, in steps, if all paces are scaled so that the new steps
  // are one less than these points.
  void find_old_times(std::size_t count, std::vector<double>& old_times) const;

 private:
  void smooth();

  std::vector<double> wishes_;  // with two more at each end
  std::vector<double> paces_;
};

}  // namespace kcs::planning
