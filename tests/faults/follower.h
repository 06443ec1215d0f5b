// Follows a planned curve from command to command.
#pragma once

#include "server/planning/plan.h"

namespace kcs::faults {

class Follower {
 public:
  // The plan must outlive it. period: of the commands, s.
  Follower(const planning::Plan& plan, double period) : plan_(plan), phase_(plan.trajectory.begin()), period_(period) {}

  // Takes the next command: goes on to the nearest place of what can come next. Returns how far that is from it, mm.
  double follow(const motion::Vector& command);

  // Where it is in the plan, s.
  double time() const { return time_; }
  // The last command was a place as much later in the plan as time went by: the planned pace.
  bool as_planned() const { return as_planned_; }

 private:
  motion::Vector at(double time);
  double distance(double time, const motion::Vector& command) { return (at(time) - command).norm(); }

  const planning::Plan& plan_;
  motion::Trajectory::Iterator phase_;
  double period_, time_ = 0;
  bool as_planned_ = false;
};

}  // namespace kcs::faults
