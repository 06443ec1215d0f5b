// A program that is larger than the server is willing to read.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "server/gcode/place.h"
#include "server/planning/invalid_input.h"

namespace kcs::gcode {

// A member of Options, and what it is set to.
struct Cap {
  std::string_view name;
  std::size_t value = 0;
};

// Thrown when a program reaches a cap of Options. There is nothing wrong with the program: a server with a higher cap
// would plan it. The message names the cap.
class CapReached : public planning::InvalidInput {
 public:
  CapReached(Cap cap, Place place, const std::string& reason) : CapReached(cap, {{field_of(place), reason}}) {}
  CapReached(Cap cap, std::vector<planning::Violation> violations) : InvalidInput(std::move(violations)), cap_(cap) {}

  Cap cap() const { return cap_; }

 private:
  Cap cap_;
};

}  // namespace kcs::gcode
