// Between the coordinates of a program and those of the machine.
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "server/planning/toolpath.h"

namespace kcs::gcode {

using planning::Vector;

inline constexpr int kWorkOffsets = 9;  // G54 to G59.3

// A work coordinate system.
struct WorkOffset {
  Vector origin = Vector::Zero();  // in machine coordinates, mm
  double rotation = 0;             // about Z, degrees, > 0 counterclockwise
  bool is_set = false;             // by the program
};

// The coordinates that a block states, each of X, Y and Z or none of them, mm.
using Stated = std::array<std::optional<double>, 3>;

// A machine coordinate is a program's coordinate plus the offset of G92 or G52, turned by the work coordinate system in
// force, plus that system's origin and the tool's offset. All of them are zero when a program starts: kcs does not know
// what the operator has set.
class Coordinates {
 public:
  Vector to_machine(const Vector& program) const;
  Vector to_program(const Vector& machine) const;

  // A direction or distance in the program's axes, in those of the machine.
  Vector turned(const Vector& program) const;
  bool is_turned() const { return sine_ != 0 || cosine_ != 1; }

  // `from` (machine coordinates) with what `stated` replaces in the program's coordinates, or adds there if
  // `incremental`. Without a turn, what is not stated stays as it is to the last bit.
  Vector moved(const Vector& from, const Stated& stated, bool incremental) const;

  // 1 to 9: G54 to G59.3.
  int system() const { return system_; }
  void choose(int system);
  const WorkOffset& work_offset(int system) const { return work_offsets_[static_cast<std::size_t>(system - 1)]; }
  void set_work_offset(int system, const WorkOffset& offset);

  // Of G92 or G52, in the axes of the work coordinate system, mm.
  const Vector& local() const { return local_; }
  void set_local(const Vector& offset);

  // What the tool's tip is away from where the machine's coordinates are measured, mm.
  const Vector& tool() const { return tool_; }
  void set_tool(const Vector& offset);

 private:
  void update();

  std::array<WorkOffset, kWorkOffsets> work_offsets_;
  int system_ = 1;
  Vector local_ = Vector::Zero();
  Vector tool_ = Vector::Zero();
  // Of what is in force:
  double sine_ = 0;
  double cosine_ = 1;
  Vector shift_ = Vector::Zero();  // where the program's zero is in machine coordinates, mm
};

}  // namespace kcs::gcode
