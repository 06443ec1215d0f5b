// Judges what drives were commanded: by the commands alone, and the plan that they should have followed.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "server/motion/limits.h"
#include "server/planning/plan.h"

namespace kcs::faults {

// One command each period, mm.
using Commands = std::vector<motion::Vector>;

// Of a recording of kcs-gateway attach.
Commands read_recording(const std::filesystem::path& file);

struct Verdict {
  double largest_share = 0;  // of a limit of velocity, acceleration or jerk, by the differences of the commands
  double farthest = 0;       // from the planned curve, mm
  double reached = 0;        // of the plan, s
  std::size_t stops = 0;     // from motion to rest
  std::string fault;         // the first thing that is wrong
};

// The commands must begin at the plan's start, and follow its curve forward without leaving any of it out.
// complete: to its very end.
Verdict judge(const Commands& commands, const planning::Plan& plan, const motion::AxisLimits& limits, double period,
              bool complete);

}  // namespace kcs::faults
