#include "server/gcode/system_parameters.h"

#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <string_view>

namespace kcs::gcode {
namespace {

constexpr int kFirstOfMachine = 5061;
constexpr int kCoordinateSystem = 5220;
constexpr int kFirstWorkOffset = 5221;
constexpr int kLastWorkOffset = 5390;
constexpr int kNumbersOfWorkOffset = 20;  // X, Y, Z, six other axes, and the turn
constexpr int kTurnOfWorkOffset = 9;
constexpr int kFirstLocalOffset = 5211;
constexpr int kLastLocalOffset = 5219;
constexpr int kFirstToolOffset = 5401;
constexpr int kLastToolOffset = 5409;
constexpr int kFirstPosition = 5420;

// In the program's coordinates and unit of length.
double position(const Interpreter& machine, int axis) {
  return machine.program_position()[axis] / machine.modes().unit;
}

double coordinate_system_code(const Interpreter& machine) {
  const int number = machine.coordinates().system();
  return number <= 6 ? code(53 + number) : code(59, number - 6);
}

double motion_code(const Interpreter& machine) {
  switch (machine.modes().motion) {
    case Motion::kRapid:
      return code(0);
    case Motion::kLine:
      return code(1);
    case Motion::kClockwiseArc:
      return code(2);
    case Motion::kCounterclockwiseArc:
      return code(3);
    case Motion::kCycle:
      return machine.modes().cycle;
    default:
      return code(80);
  }
}

double plane_code(const Interpreter& machine) {
  switch (machine.modes().plane.normal) {
    case kPlaneZx.normal:
      return code(18);
    case kPlaneYz.normal:
      return code(19);
    default:
      return code(17);
  }
}

struct Answer {
  std::string_view name;
  double (*value)(const Interpreter& machine, Place place);
};

constexpr std::array<Answer, 18> kAnswers{
    {{"_line", [](const Interpreter&, Place place) { return static_cast<double>(place.line); }},
     {"_x", [](const Interpreter& machine, Place) { return position(machine, 0); }},
     {"_y", [](const Interpreter& machine, Place) { return position(machine, 1); }},
     {"_z", [](const Interpreter& machine, Place) { return position(machine, 2); }},
     {"_coord_system", [](const Interpreter& machine, Place) { return coordinate_system_code(machine); }},
     {"_motion_mode", [](const Interpreter& machine, Place) { return motion_code(machine); }},
     {"_plane", [](const Interpreter& machine, Place) { return plane_code(machine); }},
     {"_metric", [](const Interpreter& machine, Place) { return machine.modes().unit == 1 ? 1.0 : 0.0; }},
     {"_imperial", [](const Interpreter& machine, Place) { return machine.modes().unit == 1 ? 0.0 : 1.0; }},
     {"_absolute", [](const Interpreter& machine, Place) { return machine.modes().incremental ? 0.0 : 1.0; }},
     {"_incremental", [](const Interpreter& machine, Place) { return machine.modes().incremental ? 1.0 : 0.0; }},
     {"_ijk_absolute_mode",
      [](const Interpreter& machine, Place) { return machine.modes().absolute_centres ? 1.0 : 0.0; }},
     {"_inverse_time", [](const Interpreter& machine, Place) { return machine.modes().inverse_time ? 1.0 : 0.0; }},
     {"_units_per_minute", [](const Interpreter& machine, Place) { return machine.modes().inverse_time ? 0.0 : 1.0; }},
     {"_units_per_rev", [](const Interpreter&, Place) { return 0.0; }},
     {"_tool_offset",
      [](const Interpreter& machine, Place) { return machine.coordinates().tool().isZero() ? 0.0 : 1.0; }},
     {"_lathe_diameter_mode", [](const Interpreter&, Place) { return 0.0; }},
     {"_lathe_radius_mode", [](const Interpreter&, Place) { return 1.0; }}}};

// What LinuxCNC gives a meaning and kcs cannot answer, each between blanks.
constexpr std::string_view kUnknown =
    " _a _b _c _u _v _w _abs_x _abs_y _abs_z _abs_a _abs_b _abs_c _abs_u _abs_v _abs_w _ccomp _feed _rpm "
    "_retract_r_plane _retract_old_z _spindle_rpm_mode _spindle_css_mode _spindle_on _spindle_cw _mist _flood "
    "_speed_override _feed_override _adaptive_feed _feed_hold _current_tool _current_pocket _selected_tool "
    "_selected_pocket _remap_level _task _vmajor _vminor ";
// Names that begin so are read from LinuxCNC's own files and signals.
constexpr std::string_view kIniFile = "_ini[";
constexpr std::string_view kSignal = "_hal[";

const Answer* find_answer(const std::string& name) {
  const auto* found = std::find_if(kAnswers.begin(), kAnswers.end(), [&](const Answer& a) { return a.name == name; });
  return found == kAnswers.end() ? nullptr : found;
}

bool is_unknown(const std::string& name) {
  return kUnknown.find(" " + name + " ") != std::string_view::npos || name.starts_with(kIniFile) ||
         name.starts_with(kSignal);
}

// Element `index` of a row of nine axes, of which kcs has the first three, in the program's unit of length.
double element(const Vector& row, int index, const Interpreter& machine) {
  return index < 3 ? row[index] / machine.modes().unit : 0;
}

double element_of_work_offset(int index, const Interpreter& machine) {
  const WorkOffset& offset = machine.coordinates().work_offset(1 + index / kNumbersOfWorkOffset);
  const int inside = index % kNumbersOfWorkOffset;
  return inside == kTurnOfWorkOffset ? offset.rotation : element(offset.origin, inside, machine);
}

std::optional<double> numbered_answer(int number, const Interpreter& machine) {
  if (number == kCoordinateSystem) return machine.coordinates().system();
  if (number >= kFirstWorkOffset && number <= kLastWorkOffset) {
    return element_of_work_offset(number - kFirstWorkOffset, machine);
  }
  if (number >= kFirstLocalOffset && number <= kLastLocalOffset) {
    return element(machine.coordinates().local(), number - kFirstLocalOffset, machine);
  }
  if (number >= kFirstToolOffset && number <= kLastToolOffset) {
    return element(machine.coordinates().tool(), number - kFirstToolOffset, machine);
  }
  if (number >= kFirstPosition && number < kFirstPosition + 3) return position(machine, number - kFirstPosition);
  return std::nullopt;
}

}  // namespace

bool is_of_machine(const Parameter& parameter) {
  if (parameter.number != 0) return parameter.number >= kFirstOfMachine;
  return parameter.name.starts_with('_') && (find_answer(parameter.name) != nullptr || is_unknown(parameter.name));
}

double value_of_machine(const Parameter& parameter, const Interpreter& machine, Place place) {
  if (parameter.number != 0) {
    if (const auto answer = numbered_answer(parameter.number, machine)) return *answer;
  } else if (const Answer* answer = find_answer(parameter.name)) {
    return answer->value(machine, place);
  }
  refuse(place, parameter.text() +
                    " asks for something about the machine that kcs does not know. Write the number itself instead.");
}

}  // namespace kcs::gcode
