// What a run cannot do now.
#pragma once

#include <stdexcept>

namespace kcs::runs {

// Thrown where a run is asked for what it cannot do now. what() says why, and what to do.
struct NotNow : std::runtime_error {
  using std::runtime_error::runtime_error;
};

}  // namespace kcs::runs
