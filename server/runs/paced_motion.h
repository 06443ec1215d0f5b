// The motion of a plan at a changing pace, exactly: what it reaches, and its setpoints.
#pragma once

#include <string>

#include "server/motion/limits.h"
#include "server/runs/clock.h"
#include "server/runs/plan_window.h"

namespace kcs::runs {

// Whether a stretch of the motion keeps every axis inside its limits: velocity, acceleration and jerk are polynomials
// of time between two phases of the plan, and their extremes are bounded by their Bernstein coefficients, not sampled.
// Returns what is wrong; empty: nothing. It needs no look at the path: the motion is on the plan's own curve.
std::string verify(PlanWindow& plan, const ClockPhase& clock, const motion::AxisLimits& limits);

// Where the tool is at a time of the plan, mm.
motion::Vector position(PlanWindow& plan, double plan_time);

}  // namespace kcs::runs
