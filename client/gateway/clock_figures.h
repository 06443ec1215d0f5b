// How a thread kept its clock.
#pragma once

#include <cstdint>

#include "client/gateway/lateness.h"

namespace kcs::gateway {

struct ClockFigures {
  bool fifo = false;                 // the playing thread ran in real time
  bool memory_locked = false;        // its memory stayed in RAM
  Lateness lateness;                 // of the ticks
  std::uint64_t late_ticks = 0;      // that began more than one period late
  std::uint64_t missed_periods = 0;  // that passed without a tick; the ticks after them came that much later
  double out_of_step_us = 0;         // how far the ticks were from the drives' own clock at most
};

}  // namespace kcs::gateway
