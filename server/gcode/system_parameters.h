// The parameters with which a program asks where the machine is and what is in force. No program can set them.
#pragma once

#include "server/gcode/interpreter.h"
#include "server/gcode/parameter.h"
#include "server/gcode/place.h"

namespace kcs::gcode {

// Those from #5061 on, and the names that LinuxCNC gives a meaning.
bool is_of_machine(const Parameter& parameter);

// The value of one of them before the block that asks. kcs knows:
//   #5220, #<_coord_system>        the work offset in force: 1 to 9, and G54 to G59.3 times ten
//   #5211 to #5219                 the offset of G92 or G52
//   #5221 to #5390                 the work offsets: 20 numbers each, the turn being the tenth
//   #5401 to #5409, #<_tool_offset>  the tool's offset, and whether there is one
//   #5420 to #5422, #<_x> to #<_z> where the tool is, in the program's coordinates and unit of length
//   #<_line>                       the line that asks
//   #<_motion_mode>, #<_plane>     G words times ten, and 1 or 0 for whether each of these holds: #<_metric>,
//                                  #<_imperial>, #<_absolute>, #<_incremental>, #<_ijk_absolute_mode>,
//                                  #<_inverse_time>, #<_units_per_minute>, #<_units_per_rev>,
//                                  #<_lathe_diameter_mode>, #<_lathe_radius_mode>
// Refuses, naming `place`, all others: what probes, the spindle, the tool table and the operator do is not in a
// program.
double value_of_machine(const Parameter& parameter, const Interpreter& machine, Place place);

}  // namespace kcs::gcode
