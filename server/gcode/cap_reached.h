// A program that is larger than the server is willing to read.
#pragma once

#include "server/gcode/place.h"
#include "server/planning/invalid_input.h"

namespace kcs::gcode {

// Thrown when a program reaches a cap of Options. There is nothing wrong with the program: a server with a higher cap
// would plan it. The message names the cap.
class CapReached : public planning::InvalidInput {
 public:
  CapReached(Place place, const std::string& reason) : InvalidInput({{field_of(place), reason}}) {}
};

}  // namespace kcs::gcode
