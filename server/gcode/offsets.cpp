#include "server/gcode/offsets.h"

#include <cmath>
#include <string>

#include "server/gcode/lengths.h"

namespace kcs::gcode {
namespace {

constexpr int kMaxTool = 99'999;  // the highest number of a tool

int whole_of(const Words& words, char letter, int highest, const std::string& what) {
  const double value = words.value(letter);
  if (value < 0 || value > highest || value != std::floor(value)) {
    refuse(words.place(letter), what + ": a whole number from 0 to " + std::to_string(highest) + ".");
  }
  return static_cast<int>(value);
}

// The number of a work coordinate system, as G54 to G59.3 choose it.
int system_of(int word) {
  const int tenth = word - code(59);
  return tenth > 0 ? 6 + tenth : word / 10 - 53;
}

}  // namespace

void Offsets::choose(const Words& words, const Codes& codes, double unit) {
  if (words.has('T')) selected_tool_ = whole_of(words, 'T', kMaxTool, "T chooses a tool by its number");
  if (codes.has(Group::kToolChange)) tool_ = selected_tool_;
  if (codes.has(Group::kToolLength)) choose_tool_length(words, codes, unit);
  if (!codes.has(Group::kWorkOffset)) return;
  coordinates_.choose(system_of(codes[Group::kWorkOffset]));
  if (coordinates_.work_offset(coordinates_.system()).is_set) return;
  notices_.add({'G', code(54)}, codes.place(Group::kWorkOffset).line, [] {
    return "Work offsets (G54 to G59.3) count as zero until the program sets them with G10 L2 or L20: its coordinates "
           "are the machine's.";
  });
}

void Offsets::choose_tool_length(const Words& words, const Codes& codes, double unit) {
  const Place place = codes.place(Group::kToolLength);
  switch (codes[Group::kToolLength]) {
    case code(43):
      coordinates_.set_tool(length_of_tool(words, place));
      break;
    case code(43, 1): {
      if (!words.has_any(kAxes)) refuse(place, "G43.1 needs the tool's offset: at least one of X, Y and Z.");
      const Stated stated = stated_by(words, unit);
      Vector offset = coordinates_.tool();
      for (int axis = 0; axis < 3; ++axis) offset[axis] = stated[static_cast<std::size_t>(axis)].value_or(offset[axis]);
      coordinates_.set_tool(offset);
      break;
    }
    case code(43, 2):
      if (!words.has('H')) refuse(place, "G43.2 needs the number of the tool whose offset is added: H.");
      coordinates_.set_tool(coordinates_.tool() + length_of_tool(words, place));
      break;
    default:  // G49
      coordinates_.set_tool(Vector::Zero());
      break;
  }
}

// The length of the tool H, or of the one in the spindle.
Vector Offsets::length_of_tool(const Words& words, Place place) {
  const int number = words.has('H') ? whole_of(words, 'H', kMaxTool, "H chooses a tool by its number") : tool_;
  const auto found = tools_.find(number);
  if (found != tools_.end()) return found->second;
  notices_.add({'H'}, place.line, [] {
    return "Tool lengths (G43, H) count as zero where the program does not state them with G10 L1 or G43.1: kcs has no "
           "tool table.";
  });
  return Vector::Zero();
}

void Offsets::set(const Words& words, const Codes& codes, double unit, const Vector& position) {
  switch (codes[Group::kThisBlock]) {
    case code(10):
      set_stored(words, codes, unit, position);
      break;
    case code(52):
    case code(92):
      set_local(words, codes, unit, position);
      break;
    case code(92, 1):
      saved_local_ = Vector::Zero();
      [[fallthrough]];
    case code(92, 2):
      coordinates_.set_local(Vector::Zero());
      break;
    case code(92, 3):
      coordinates_.set_local(saved_local_);
      break;
    default:
      break;
  }
}

void Offsets::set_stored(const Words& words, const Codes& codes, double unit, const Vector& position) {
  const Place place = codes.place(Group::kThisBlock);
  const double what = words.has('L') ? words.value('L') : 0;
  if (!words.has('P') || !words.has('L')) {
    refuse(place,
           "G10 needs L and P: G10 L2 P1 X10 sets the origin of G54, L20 the coordinates where the tool is, L1 "
           "the length of tool P.");
  }
  if (what == 2 || what == 20) {
    set_work_offset(words, unit, position, what == 20);
  } else if (what == 1) {
    set_tool(words, unit);
  } else {
    refuse(words.place('L'),
           "of G10, kcs knows L1, L2 and L20. L10 and L11 measure a tool on the machine: measure it before, and state "
           "its length with G10 L1 or G43.1.");
  }
}

void Offsets::set_work_offset(const Words& words, double unit, const Vector& position, bool by_position) {
  const int number = whole_of(words, 'P', kWorkOffsets,
                              "P of G10 L2 and L20 is 1 to 9 for G54 to G59.3, 0 for the "
                              "one in force");
  const int system = number == 0 ? coordinates_.system() : number;
  const Stated stated = stated_by(words, unit);
  WorkOffset offset = coordinates_.work_offset(system);
  offset.is_set = true;
  if (words.has('R')) {
    if (by_position) refuse(words.place('R'), "R turns the coordinates with G10 L2 only.");
    offset.rotation = words.value('R');
  }
  // Where the origin must lie for the tool to be at what is stated, and at its old coordinates otherwise.
  Coordinates there = coordinates_;
  there.set_work_offset(system, offset);
  there.choose(system);
  Vector program = there.to_program(position);
  for (int axis = 0; axis < 3; ++axis) {
    const std::optional<double>& value = stated[static_cast<std::size_t>(axis)];
    if (!value) continue;
    if (by_position) {
      program[axis] = *value;
    } else {
      offset.origin[axis] = *value;
    }
  }
  if (by_position) offset.origin += position - there.to_machine(program);
  coordinates_.set_work_offset(system, offset);
}

void Offsets::set_tool(const Words& words, double unit) {
  const int number = whole_of(words, 'P', kMaxTool, "P of G10 L1 is the number of a tool");
  const Stated stated = stated_by(words, unit);
  Vector& offset = tools_.try_emplace(number, Vector::Zero()).first->second;
  for (int axis = 0; axis < 3; ++axis) offset[axis] = stated[static_cast<std::size_t>(axis)].value_or(offset[axis]);
}

void Offsets::set_local(const Words& words, const Codes& codes, double unit, const Vector& position) {
  const Place place = codes.place(Group::kThisBlock);
  const std::string name = code_name('G', codes[Group::kThisBlock]);
  if (!words.has_any(kAxes)) {
    if ((words.present() & ~letters("N")) == 0) {
      refuse(place, name + " needs at least one of X, Y and Z. G92.1 removes the offset.");
    }
    notices_.add({'G', codes[Group::kThisBlock]}, place.line,
                 [&] { return name + " without X, Y or Z has no effect."; });
    return;
  }
  const Stated stated = stated_by(words, unit);
  const Vector program = coordinates_.to_program(position);
  Vector local = coordinates_.local();
  for (int axis = 0; axis < 3; ++axis) {
    const std::optional<double>& value = stated[static_cast<std::size_t>(axis)];
    if (value) local[axis] = codes[Group::kThisBlock] == code(52) ? *value : local[axis] + program[axis] - *value;
  }
  coordinates_.set_local(local);
  saved_local_ = local;
}

}  // namespace kcs::gcode
