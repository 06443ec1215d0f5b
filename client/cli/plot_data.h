// What a plot shows, gathered from a stream of setpoints.
#pragma once

#include <cstddef>
#include <utility>
#include <vector>

#include "client/cli/path_outline.h"
#include "client/sdk/plan.h"
#include "client/sdk/planner.h"

namespace kcs::cli {

using Curve = std::vector<std::pair<double, double>>;  // time in s, value

struct PlotData {
  double from_s = 0;
  double to_s = 0;
  std::vector<Stroke> path;         // seen from above
  Curve speed;                      // along the path, mm/s
  std::vector<Curve> acceleration;  // one per axis, mm/s²
  std::vector<Curve> jerk;          // one per axis, mm/s³
};

// Samples the window [from, to] of a plan, 0 ≤ from < to, at `coarsest_period_s` or as much finer as the picture needs.
PlotData gather_plot_data(client::Planner& planner, const client::Plan& plan, double from_s, double to_s,
                          double coarsest_period_s);

}  // namespace kcs::cli
