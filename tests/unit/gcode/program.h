// Reads whole programs for the tests of the G-code reader.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "server/gcode/options.h"
#include "server/gcode/reader.h"
#include "server/planning/invalid_input.h"
#include "server/planning/toolpath.h"

namespace kcs::gcode {

struct Program {
  planning::Toolpath path;
  std::vector<Notice> notices;
  double chord_error = 0;

  const std::vector<planning::Segment>& segments() const { return path.segments; }
  const planning::Vector& end() const { return path.segments.back().end; }
};

// Where the moves end in X, mm.
inline std::vector<double> x_of(const Program& program) {
  std::vector<double> ends;
  for (const planning::Segment& segment : program.segments()) ends.push_back(segment.end.x());
  return ends;
}

// The lines that the moves come from.
inline std::vector<std::uint32_t> lines_of(const Program& program) {
  std::vector<std::uint32_t> lines;
  for (const planning::Segment& segment : program.segments()) lines.push_back(segment.line);
  return lines;
}

// Gathers the segments in `path`, which must live as long.
inline TakeSegment into(planning::Toolpath& path) {
  return [&path](const planning::Segment& segment) { path.segments.push_back(segment); };
}

inline Program read_program(std::string_view text, const Options& options = {}) {
  Program program{.path = {{.start = options.start}}};
  Reader reader(options, into(program.path));
  reader.read(text);
  reader.finish();
  program.notices = reader.notices();
  program.chord_error = reader.largest_chord_error();
  return program;
}

// "field: reason" of the refusal of a program; empty if it is accepted.
inline std::string refusal_of(std::string_view text, const Options& options = {}) {
  try {
    read_program(text, options);
  } catch (const planning::InvalidInput& refusal) {
    return refusal.what();
  }
  return {};
}

}  // namespace kcs::gcode
