// What happened at each tick, on its way from the thread that plays to the one that measures.
#pragma once

#include <cstddef>

#include "client/gateway/one_way_queue.h"
#include "client/gateway/vector.h"

namespace kcs::gateway {

struct Tick {
  Vector commanded_mm = Vector::Zero();  // what the drives were given
  Vector actual_mm = Vector::Zero();     // what their encoders read one period later, when it was due
  std::size_t buffered = 0;              // setpoints that were left on the queue
  bool filling = false;                  // more setpoints were to come from the server
  double clock_s = 0;                    // when that was, on the monotonic clock
};

using Trace = OneWayQueue<Tick>;

}  // namespace kcs::gateway
