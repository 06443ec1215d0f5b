// Judges what drives were commanded: by the commands alone, and the plans that they should have followed.
#pragma once

#include <deque>
#include <string>
#include <vector>

#include "server/motion/limits.h"
#include "server/planning/plan.h"
#include "tests/faults/drives.h"

namespace kcs::faults {

// One run of a plan.
struct Run {
  planning::Plan plan;
  double begun = 0;       // on the clock of the drives, s; the machine rested then
  bool complete = false;  // it was to go to its very end
};
using Runs = std::deque<Run>;

// Where the machine was with a command.
struct Place {
  const Run* run;   // the one that had begun last; null: none had
  double time;      // of its plan, s
  bool as_planned;  // at the planned pace
  bool moves;
};

struct Verdict {
  double largest_share = 0;   // of a limit of velocity, acceleration or jerk, by the differences of the commands
  double farthest = 0;        // from the planned curve, mm
  std::vector<Place> places;  // one for each command
  std::string fault;          // the first thing that is wrong
};

// From one run to the next the commands must follow the planned curve forward without leaving any of it out, and end at
// rest. The places that it returns point to the runs.
Verdict judge(const Commands& commands, const Runs& runs, const motion::AxisLimits& limits, double period);

}  // namespace kcs::faults
