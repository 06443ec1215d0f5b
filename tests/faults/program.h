// The programs that are disturbed, as paths without an end that are run piece by piece.
#pragma once

#include <kcs/v1/planning.pb.h>

#include <cstddef>
#include <string>
#include <vector>

#include "server/planning/plan.h"
#include "server/planning/toolpath.h"

namespace kcs::faults {

// The limits of deploy/machines/machining-center.toml, which plans and judges go by.
motion::AxisLimits machine_limits();

// A closed path: after its last segment comes its first.
struct Program {
  std::string name;
  std::vector<planning::Segment> segments;
};

// Many sharp corners, and a program of dense curves: the demo's part.
Program sharp_program();
Program dense_program();

// The same plan, made here to judge by.
planning::Plan make_plan(const planning::Toolpath& path);
// What asks a server for it.
std::vector<v1::CreatePlanRequest> request_of(const planning::Toolpath& path);

// Goes along a program.
class ProgramCursor {
 public:
  // piece: the length of a piece, mm, at least; it ends with a whole segment.
  ProgramCursor(const Program& program, double piece) : program_(program), piece_(piece) {}

  // The piece from where the last one ended.
  planning::Toolpath next();
  // The piece from a place where the motion along the last one was broken off.
  planning::Toolpath next_from(const motion::Vector& place);

 private:
  planning::Toolpath piece();

  const Program& program_;
  double piece_;
  motion::Vector begin_ = motion::Vector::Zero(), place_ = begin_;  // of the last piece: its beginning and end
  std::size_t first_ = 0, next_ = 0;  // segments: its first one, and the one after it; counted on around the program
};

}  // namespace kcs::faults
