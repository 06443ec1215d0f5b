// One number per axis: X, Y, Z.
#pragma once

#include <Eigen/Core>

namespace kcs::gateway {

// A machine with two axes leaves Z at zero.
using Vector = Eigen::Vector3d;

}  // namespace kcs::gateway
