// Any bytes as a program: read or refused, sound if read, and the same path however they are cut.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "server/gcode/reader.h"
#include "server/planning/invalid_input.h"

namespace {

using kcs::planning::Segment;
using kcs::planning::Toolpath;

struct Outcome {
  Toolpath path;
  bool accepted = false;
};

// Reads the program in pieces of `piece` bytes.
Outcome read(std::string_view program, std::size_t axes, std::size_t piece) {
  kcs::gcode::Options options;
  options.axes = axes;
  options.max_segments = 5000;
  options.max_kept_bytes = 4000;
  options.max_blocks = 2000;
  Outcome outcome;
  try {
    kcs::gcode::Reader reader(options,
                              [&outcome](const Segment& segment) { outcome.path.segments.push_back(segment); });
    for (; !program.empty(); program.remove_prefix(std::min(piece, program.size()))) {
      reader.read(program.substr(0, piece));
    }
    reader.finish();
    outcome.accepted = true;
  } catch (const kcs::planning::InvalidInput&) {
  }
  return outcome;
}

void require(bool condition) {
  if (!condition) std::abort();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  // The first byte chooses the machine and the pieces.
  const std::size_t axes = 2 + data[0] % 2;
  const std::size_t piece = 1 + data[0] / 2;
  const std::string_view program(reinterpret_cast<const char*>(data + 1), size - 1);

  const Outcome whole = read(program, axes, size);
  const Outcome cut = read(program, axes, piece);
  require(whole.accepted == cut.accepted);
  require(whole.path.segments.size() == cut.path.segments.size());
  for (std::size_t i = 0; i < whole.path.segments.size(); ++i) {
    const Segment& segment = whole.path.segments[i];
    require(segment.end == cut.path.segments[i].end && segment.line == cut.path.segments[i].line);
    require(segment.end.allFinite() && segment.feed > 0 && segment.tolerance >= 0 && segment.tolerance <= 1000);
    require(segment.dwell >= 0 && (segment.stop || segment.dwell == 0));
    require(axes == 3 || segment.end.z() == 0);
  }
  return 0;
}
