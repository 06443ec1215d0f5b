#include "server/gcode/place.h"

#include "server/planning/invalid_input.h"

namespace kcs::gcode {

std::string field_of(Place place) {
  return "gcode, line " + std::to_string(place.line) + ", column " + std::to_string(place.column);
}

void refuse(Place place, const std::string& reason) { throw planning::InvalidInput({{field_of(place), reason}}); }

}  // namespace kcs::gcode
