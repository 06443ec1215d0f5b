// The gnuplot script of a plot, data included.
#pragma once

#include <string>

#include "client/cli/plot_data.h"
#include "client/sdk/plan.h"

namespace kcs::cli {

enum class PictureFormat { kSvg, kPng };

// Draws the path (coloured by speed, the same scale on both axes) beside speed, acceleration and jerk against time,
// with the machine's limits. `picture` is the file that gnuplot shall write.
std::string plot_script(const PlotData& data, const client::Plan& plan, const std::string& title,
                        const std::string& picture, PictureFormat format);

}  // namespace kcs::cli
