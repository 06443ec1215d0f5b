// How planning is stopped before its end.
#pragma once

#include <exception>
#include <stop_token>

namespace kcs::planning {

// Thrown by planning that was asked to stop (PlanOptions::stop). What was planned by then is no plan.
class Stopped : public std::exception {
 public:
  const char* what() const noexcept override { return "planning was stopped before its end"; }
};

// Throws Stopped if it is asked for. To be called in each round of every loop that may last for milliseconds; a call
// takes a nanosecond.
inline void throw_if_stopped(const std::stop_token& stop) {
  if (stop.stop_requested()) throw Stopped();
}

}  // namespace kcs::planning
