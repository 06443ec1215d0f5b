// Requests as bytes: what the store keeps makes the same request again.
#include "server/service/request_code.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "server/service/upload.h"
#include "tests/property/random.h"
#include "tests/service/test_server.h"

namespace kcs::service::test {
namespace {

using kcs::test::Random;

constexpr int kRequests = 4000;

std::vector<double> vector(Random& random, std::uint32_t axes, double low, double high) {
  std::vector<double> numbers;
  for (std::uint32_t axis = 0; axis < axes; ++axis) {
    numbers.push_back(random.chance(0.1) ? -0.0 : random.uniform(low, high));
  }
  return numbers;
}

v1::PlanOptions random_options(Random& random, bool is_gcode) {
  v1::PlanOptions options;
  v1::Machine& machine = *options.mutable_machine();
  machine.set_axes(random.one_of({2U, 3U}));
  for (std::uint32_t axis = 0; axis < machine.axes(); ++axis) {
    machine.add_velocity_mm_s(random.log_uniform(1, 1e4));
    machine.add_acceleration_mm_s2(random.log_uniform(10, 1e5));
    machine.add_jerk_mm_s3(random.log_uniform(100, 1e7));
  }
  if (random.chance(0.5)) machine.set_name(random.one_of({"", "Fräse 1", "\"'\\;--"}));
  if (random.chance(0.5)) machine.set_rapid_mm_s(random.log_uniform(1e-6, 1e6));
  if (random.chance(0.5)) options.set_tolerance_mm(random.one_of({0.0, -0.0, 0.01, random.uniform(0, 1000)}));
  options.set_tolerance_kind(random.one_of({v1::TOLERANCE_KIND_UNSPECIFIED, v1::TOLERANCE_KIND_CORNER_DISTANCE}));
  options.set_strategy(static_cast<v1::CornerStrategy>(random.bits() % 6));
  if (random.chance(0.3)) options.set_feed_mm_s(random.log_uniform(1e-6, 1e6));
  if (random.chance(0.3)) options.set_start_speed_mm_s(random.uniform(0, 100));
  if (random.chance(0.3)) options.set_start_acceleration_mm_s2(random.uniform(-1000, 1000));
  if (random.chance(0.3)) options.set_end_speed_mm_s(random.uniform(0, 100));
  if (is_gcode && random.chance(0.5)) {
    for (const double number : vector(random, machine.axes(), -1e3, 1e3)) options.add_start_mm(number);
  }
  return options;
}

v1::PathChunk random_chunk(Random& random, std::uint32_t axes, bool is_first, bool is_last) {
  v1::PathChunk chunk;
  const std::uint64_t points = (is_first && is_last ? 2 : is_first ? 1 : 0) + random.bits() % 12;
  for (std::uint64_t point = 0; point < points; ++point) {
    const bool stays = point > 0 && random.chance(0.1);  // a segment of no length
    const auto numbers = vector(random, axes, -1e7, 1e7);
    for (std::uint32_t axis = 0; axis < axes; ++axis) {
      chunk.add_points_mm(stays ? chunk.points_mm(chunk.points_mm_size() - static_cast<int>(axes)) : numbers[axis]);
    }
  }
  const std::uint64_t feeds = random.chance(0.5) ? points : 1;
  for (std::uint64_t i = 0; i < feeds; ++i) chunk.add_feed_mm_s(random.log_uniform(1e-6, 1e6));
  const std::uint64_t tolerances = random.one_of<std::uint64_t>({0, 1, points});
  for (std::uint64_t i = 0; i < tolerances; ++i) {
    chunk.add_tolerance_mm(random.one_of({0.0, 1000.0, random.uniform(0, 1)}));
  }
  if (random.chance(0.5)) {
    for (std::uint64_t i = 0; i < points; ++i) {
      chunk.add_line(random.one_of({1U, 0xFFFF'FFFFU, static_cast<std::uint32_t>(1 + random.bits() % 1000)}));
    }
  }
  for (std::uint32_t point = 0; point < points; ++point) {
    if (!random.chance(0.2)) continue;
    v1::Stop& stop = *chunk.add_stops();
    stop.set_point(point);
    stop.set_dwell_s(random.one_of({0.0, 1e6, random.uniform(0, 10)}));
  }
  for (std::uint32_t point = 0; point < points; ++point) {
    if (!random.chance(0.2)) continue;
    v1::PathMarker& marker = *chunk.add_markers();
    marker.set_point(point);
    marker.mutable_marker()->set_kind(static_cast<v1::MarkerKind>(1 + random.bits() % 6));
    marker.mutable_marker()->set_value(random.one_of({0.0, -0.0, 1e6, random.uniform(0, 1e5)}));
  }
  return chunk;
}

std::string random_gcode(Random& random) {
  std::string program = random.chance(0.5) ? "G21 G90 F1200\n" : "(M\xfcller, Latin-1)\nG20 G91 F50\r\n";
  const auto number = [&random] { return std::to_string(random.uniform(-50, 50)); };
  for (std::uint64_t line = 1 + random.bits() % 10; line > 0; --line) {
    switch (random.bits() % 7) {
      case 0:
        program += "G0 X" + number() + "\n";
        break;
      case 1:
        program += "G1 X" + number() + " Y" + number() + "\n";
        break;
      case 2: {  // a half circle, back to where it began
        const std::string radius = std::to_string(random.uniform(1, 50));
        program += "G91 G2 X" + radius + " I" + std::to_string(std::stod(radius) / 2) + "\n";
        break;
      }
      case 3:
        program += "G64 P" + std::to_string(random.uniform(0, 0.1)) + "\n";
        break;
      case 4:
        program += "G4 P0.5\n";
        break;
      case 5:
        program += "M3 S1000 T7\n";
        break;
      default:
        program += "N10 G1 Y" + number() + " (a comment)\n";
    }
  }
  return program + "G90 G1 X1 Y2";
}

void expect_same(const jobs::PlanRequest& request, const jobs::PlanRequest& again) {
  EXPECT_EQ(again.name, request.name);
  const jobs::RequestOptions &a = request.options, &b = again.options;
  EXPECT_EQ(b.machine_name, a.machine_name);
  EXPECT_EQ(b.planning.limits.axes, a.planning.limits.axes);
  EXPECT_EQ(b.planning.limits.velocity, a.planning.limits.velocity);
  EXPECT_EQ(b.planning.limits.acceleration, a.planning.limits.acceleration);
  EXPECT_EQ(b.planning.limits.jerk, a.planning.limits.jerk);
  EXPECT_EQ(b.planning.tolerance_kind, a.planning.tolerance_kind);
  EXPECT_EQ(b.planning.strategy, a.planning.strategy);
  EXPECT_EQ(b.rapid, a.rapid);
  EXPECT_EQ(b.tolerance, a.tolerance);
  EXPECT_EQ(b.feed, a.feed);
  EXPECT_EQ(b.start, a.start);
  EXPECT_EQ(b.start_speed, a.start_speed);
  EXPECT_EQ(b.start_acceleration, a.start_acceleration);
  EXPECT_EQ(b.end_speed, a.end_speed);
  EXPECT_EQ(again.max_chord_error, request.max_chord_error);
  const auto is_same_notice = [](const gcode::Notice& one, const gcode::Notice& other) {
    return one.line == other.line && one.text == other.text && one.count == other.count;
  };
  EXPECT_TRUE(std::ranges::equal(request.notices, again.notices, is_same_notice));
  EXPECT_EQ(again.path.start, request.path.start);
  EXPECT_EQ(again.path.start_speed, request.path.start_speed);
  EXPECT_EQ(again.path.start_acceleration, request.path.start_acceleration);
  EXPECT_EQ(again.path.end_speed, request.path.end_speed);
  const auto is_same_segment = [](const planning::Segment& one, const planning::Segment& other) {
    return one.end == other.end && one.feed == other.feed && one.tolerance == other.tolerance &&
           one.dwell == other.dwell && one.line == other.line && one.stop == other.stop;
  };
  EXPECT_TRUE(std::ranges::equal(request.path.segments, again.path.segments, is_same_segment));
}

Uploaded random_request(Random& random) {
  static const Caps caps;
  Upload upload(caps);
  const bool is_gcode = random.chance(0.3);
  const v1::PlanOptions options = random_options(random, is_gcode);
  upload.add(request(options));
  if (is_gcode) {
    upload.add(gcode(random_gcode(random)));
  } else {
    const std::uint64_t chunks = 1 + random.bits() % 4;
    for (std::uint64_t i = 0; i < chunks; ++i) {
      upload.add(request(random_chunk(random, options.machine().axes(), i == 0, i + 1 == chunks)));
    }
    upload.add(request(path(std::vector(options.machine().axes(), 1.0))));  // so that there are two points
  }
  return upload.finish();
}

TEST(RequestCode, BringsEveryKindOfRequestBack) {
  Random random(41);
  int dwells_at_start = 0, mixed_lines = 0, arcs = 0, notices = 0;
  for (int i = 0; i < kRequests && !HasFailure(); ++i) {
    SCOPED_TRACE(i);
    const Uploaded uploaded = random_request(random);
    const jobs::PlanRequest& request = uploaded.request;
    const std::string bytes = encode_request(request, uploaded.gcode);
    const jobs::PlanRequest again = decode_request(request.name, bytes, Caps());
    expect_same(request, again);
    EXPECT_EQ(encode_request(again, uploaded.gcode), bytes);

    const auto& segments = request.path.segments;
    const auto has_line = [](const planning::Segment& segment) { return segment.line > 0; };
    dwells_at_start += !segments.empty() && segments.front().end == request.path.start && segments.front().dwell > 0;
    mixed_lines += std::ranges::any_of(segments, has_line) && !std::ranges::all_of(segments, has_line);
    arcs += request.max_chord_error > 0;
    notices += !request.notices.empty();
  }
  for (const int count : {dwells_at_start, mixed_lines, arcs, notices}) EXPECT_GT(count, 100);
}

TEST(RequestCode, DamagedBytesAreNeverTakenForAnotherRequest) {
  Random random(42);
  int refused = 0;
  for (int i = 0; i < kRequests; ++i) {
    const Uploaded uploaded = random_request(random);
    std::string bytes = encode_request(uploaded.request, uploaded.gcode);
    if (random.chance(0.3)) {
      bytes.resize(random.bits() % bytes.size());
    } else {
      bytes[random.bits() % bytes.size()] ^= static_cast<char>(1U << random.bits() % 8);
    }
    try {
      // What it says is the same then: a bit of a number that does not count.
      EXPECT_EQ(decode_request(uploaded.request.name, bytes, Caps()).name, uploaded.request.name);
    } catch (const std::exception&) {
      ++refused;
    }
  }
  EXPECT_GT(refused, kRequests * 8 / 10);
}

TEST(RequestCode, OfAnotherNameIsRefused) {
  Random random(43);
  const Uploaded uploaded = random_request(random);
  const std::string bytes = encode_request(uploaded.request, uploaded.gcode);
  EXPECT_THROW(decode_request("plans/another", bytes, Caps()), std::runtime_error);
}

}  // namespace
}  // namespace kcs::service::test
