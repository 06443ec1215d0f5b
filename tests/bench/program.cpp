#include "tests/bench/program.h"

#include <fstream>
#include <iterator>
#include <stdexcept>

#include "server/gcode/reader.h"

namespace kcs::bench {

std::string text_of(const std::string& file) {
  std::ifstream stream(file);
  std::string text(std::istreambuf_iterator<char>(stream), {});
  if (!stream) throw std::runtime_error(file + " cannot be read");
  return text;
}

planning::Toolpath toolpath_of(const std::string& gcode, const gcode::Options& options) {
  planning::Toolpath path{{.start = options.start}};
  gcode::Reader reader(options, [&path](const planning::Segment& segment) { path.segments.push_back(segment); });
  reader.read(gcode);
  reader.finish();
  return path;
}

planning::PlanOptions machine(double acceleration, double jerk) {
  constexpr double kVelocity = 500;
  return {.limits = {.velocity = planning::Vector::Constant(kVelocity),
                     .acceleration = planning::Vector::Constant(acceleration),
                     .jerk = planning::Vector::Constant(jerk)}};
}

}  // namespace kcs::bench
