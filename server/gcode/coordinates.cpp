#include "server/gcode/coordinates.h"

#include "server/gcode/trigonometry.h"

namespace kcs::gcode {

Vector Coordinates::turned(const Vector& program) const {
  if (!is_turned()) return program;
  return {program.x() * cosine_ - program.y() * sine_, program.x() * sine_ + program.y() * cosine_, program.z()};
}

Vector Coordinates::to_machine(const Vector& program) const { return turned(program) + shift_; }

Vector Coordinates::to_program(const Vector& machine) const {
  Vector from_zero = machine - shift_;
  if (!is_turned()) return from_zero;
  return {from_zero.x() * cosine_ + from_zero.y() * sine_, from_zero.y() * cosine_ - from_zero.x() * sine_,
          from_zero.z()};
}

Vector Coordinates::moved(const Vector& from, const Stated& stated, bool incremental) const {
  Vector to = from;
  const int first_unturned = is_turned() ? 2 : 0;
  for (int axis = first_unturned; axis < 3; ++axis) {
    const std::optional<double>& value = stated[static_cast<std::size_t>(axis)];
    if (value) to[axis] = incremental ? from[axis] + *value : *value + shift_[axis];
  }
  if (first_unturned == 0 || (!stated[0] && !stated[1])) return to;
  Vector program = to_program(from);
  for (int axis = 0; axis < first_unturned; ++axis) {
    const double value = stated[static_cast<std::size_t>(axis)].value_or(incremental ? 0 : program[axis]);
    program[axis] = incremental ? program[axis] + value : value;
  }
  to.head<2>() = to_machine(program).head<2>();
  return to;
}

void Coordinates::choose(int system) {
  system_ = system;
  update();
}

void Coordinates::set_work_offset(int system, const WorkOffset& offset) {
  work_offsets_[static_cast<std::size_t>(system - 1)] = offset;
  update();
}

void Coordinates::set_local(const Vector& offset) {
  local_ = offset;
  update();
}

void Coordinates::set_tool(const Vector& offset) {
  tool_ = offset;
  update();
}

void Coordinates::update() {
  const WorkOffset& in_force = work_offset(system_);
  const auto [sine, cosine] = sine_and_cosine_of_degrees(in_force.rotation);
  sine_ = sine;
  cosine_ = cosine;
  shift_ = turned(local_) + in_force.origin + tool_;
}

}  // namespace kcs::gcode
