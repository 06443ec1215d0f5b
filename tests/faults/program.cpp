#include "tests/faults/program.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <iterator>
#include <limits>

#include "server/gcode/reader.h"
#include "server/planning/plan_path.h"

namespace kcs::faults {
namespace {

using motion::Vector;

constexpr double kFeed = 60;  // mm/s
constexpr double kTolerance = 0.02;
constexpr std::array<double, 3> kVelocity = {500, 500, 400}, kAcceleration = {3400, 3400, 2800},
                                kJerk = {35000, 35000, 28000};

// Starts at 0 and comes back to it.
Program make_program(const std::string& name, const std::string& gcode) {
  Program program{.name = name, .segments = {}};
  gcode::Reader reader({.feed = kFeed, .tolerance = kTolerance}, [&program](planning::Segment segment) {
    segment.feed = kFeed;  // those of no length, which only switch something, have none
    program.segments.push_back(segment);
  });
  reader.read(gcode);
  reader.finish();
  program.segments.push_back({.end = Vector::Zero(), .feed = kFeed, .tolerance = kTolerance});
  return program;
}

// From a segment's beginning to its end, mm.
double distance_to(const Vector& place, const Vector& begin, const Vector& end) {
  const Vector along = end - begin;
  const double length = along.squaredNorm();
  const double share = length == 0 ? 0 : std::clamp((place - begin).dot(along) / length, 0.0, 1.0);
  return (place - begin - share * along).norm();
}

}  // namespace

motion::AxisLimits machine_limits() {
  motion::AxisLimits limits;
  for (Eigen::Index i = 0; i < 3; ++i) {
    const auto axis = static_cast<std::size_t>(i);
    limits.velocity[i] = kVelocity[axis];
    limits.acceleration[i] = kAcceleration[axis];
    limits.jerk[i] = kJerk[axis];
  }
  return limits;
}

Program sharp_program() {
  std::string gcode = "G1 F3600\n";
  for (int i = 1; i <= 3000; ++i) {
    gcode += fmt::format("X{} Y{} Z{}\n", 4 * (i % 50), 11 * (i % 2) + i % 7, (i % 3) * 0.5);
  }
  return make_program("sharp", gcode);
}

Program dense_program() {
  std::ifstream in(KCS_SOURCE "/deploy/demo/part.ngc");
  return make_program("dense", std::string(std::istreambuf_iterator<char>(in), {}));
}

planning::Plan make_plan(const planning::Toolpath& path) { return planning::plan(path, {.limits = machine_limits()}); }

std::vector<v1::CreatePlanRequest> request_of(const planning::Toolpath& path) {
  std::vector<v1::CreatePlanRequest> request(2);
  v1::Machine& machine = *request[0].mutable_options()->mutable_machine();
  machine.set_axes(3);
  machine.mutable_velocity_mm_s()->Add(kVelocity.begin(), kVelocity.end());
  machine.mutable_acceleration_mm_s2()->Add(kAcceleration.begin(), kAcceleration.end());
  machine.mutable_jerk_mm_s3()->Add(kJerk.begin(), kJerk.end());
  v1::PathChunk& chunk = *request[1].mutable_path();
  const auto add = [&chunk](const Vector& point, double feed, double tolerance) {
    for (const double coordinate : point) chunk.add_points_mm(coordinate);
    chunk.add_feed_mm_s(feed);
    chunk.add_tolerance_mm(tolerance);
  };
  add(path.start, kFeed, kTolerance);
  for (const planning::Segment& segment : path.segments) {
    add(segment.end, segment.feed, segment.tolerance);
    if (!segment.stop) continue;
    v1::Stop& stop = *chunk.add_stops();
    stop.set_point(static_cast<std::uint32_t>(chunk.feed_mm_s_size() - 1));
    stop.set_dwell_s(segment.dwell);
  }
  return request;
}

planning::Toolpath ProgramCursor::piece() {
  planning::Toolpath path;
  path.start = place_;
  begin_ = place_;
  first_ = next_;
  for (double length = 0; length < piece_; ++next_) {
    path.segments.push_back(program_.segments[next_ % program_.segments.size()]);
    length += (path.segments.back().end - place_).norm();
    place_ = path.segments.back().end;
  }
  return path;
}

planning::Toolpath ProgramCursor::next() { return piece(); }

planning::Toolpath ProgramCursor::next_from(const Vector& place) {
  double least = std::numeric_limits<double>::infinity();
  Vector begin = begin_;
  for (std::size_t i = first_, end = next_; i < end; ++i) {
    const Vector& segment_end = program_.segments[i % program_.segments.size()].end;
    const double distance = distance_to(place, begin, segment_end);
    begin = segment_end;
    if (distance >= least) continue;
    least = distance;
    next_ = i;
  }
  place_ = place;
  return piece();
}

}  // namespace kcs::faults
