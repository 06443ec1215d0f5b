// PlanLive: the same bytes as the stored plan of the same path, while the path still comes.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <string>
#include <thread>
#include <tuple>
#include <utility>
#include <vector>

#include "tests/service/live_client.h"

namespace kcs::service::test {
namespace {

using Messages = std::vector<v1::CreatePlanRequest>;
using Columns = const google::protobuf::RepeatedPtrField<v1::Column>& (v1::SetpointBatch::*)() const;

constexpr Columns kChannels[] = {&v1::SetpointBatch::position_mm, &v1::SetpointBatch::velocity_mm_s,
                                 &v1::SetpointBatch::acceleration_mm_s2, &v1::SetpointBatch::jerk_mm_s3};

constexpr std::string_view kProgram =
    "G21 G90 G64 P0.02\n"
    "o<pocket> sub\n"
    "G3 X[#1] Y0 I[-#1] J0\n"
    "o<pocket> endsub\n"
    "F3000\n"
    "G1 X40\n"
    "Y30\n"
    "G3 X30 Y40 I-10\n"
    "G4 P0.25\n"
    "G1 X0\n"
    "M7\n"
    "#<r>=1\n"
    "o1 while [#<r> LT 9]\n"
    "G1 X#<r> Y0\n"
    "o<pocket> call [#<r>]\n"
    "#<r>=[#<r>+0.5]\n"
    "o1 endwhile\n"
    "G61\n"
    "G1 X0 Y0 Z-1\n"
    "G0 Z5\n"
    "M30\n";

// The program in pieces of so many bytes.
Messages program(std::size_t piece) {
  Messages messages = {request(options(3))};
  for (std::size_t at = 0; at < kProgram.size(); at += piece) messages.push_back(gcode(kProgram.substr(at, piece)));
  return messages;
}

// The points in pieces of so many.
Messages points(const std::vector<double>& numbers, std::size_t piece) {
  Messages messages = {request(options())};
  for (std::size_t at = 0; at < numbers.size(); at += 2 * piece) {
    const auto first = numbers.begin() + static_cast<std::ptrdiff_t>(at);
    messages.push_back(
        request(path({first, first + static_cast<std::ptrdiff_t>(std::min(2 * piece, numbers.size() - at))})));
  }
  return messages;
}

std::vector<double> zigzag(int count) {
  std::vector<double> numbers;
  for (int i = 0; i < count; ++i) numbers.insert(numbers.end(), {i * 2.0, i % 2 * 3.0});
  return numbers;
}

// Round and round in chords of 0.1 mm.
std::vector<double> circle(int count) {
  std::vector<double> numbers;
  for (int i = 0; i < count; ++i) {
    const double angle = 2 * std::numbers::pi * i / 628;
    numbers.insert(numbers.end(), {10 * std::cos(angle), 10 * std::sin(angle)});
  }
  return numbers;
}

std::vector<double> random_walk(std::uint64_t seed) {
  std::mt19937_64 random(seed);
  const auto uniform = [&] { return std::ldexp(static_cast<double>(random() >> 11), -53); };
  std::vector<double> numbers{0, 0};
  double direction = 0, turn = 1;
  const auto count = 2 + random() % 2000;
  for (std::uint64_t i = 0; i < count; ++i) {
    if (uniform() < 0.02) turn = std::exp(-8 * uniform());
    direction += turn * (uniform() - 0.5);
    const double length = std::exp(-6 * uniform());
    numbers.push_back(numbers.end()[-2] + length * std::cos(direction));
    numbers.push_back(numbers.end()[-2] + length * std::sin(direction));
  }
  return numbers;
}

// Way, segment and line of each setpoint.
std::vector<std::tuple<double, std::uint64_t, std::uint32_t>> places(const std::vector<v1::SetpointBatch>& batches) {
  std::vector<std::tuple<double, std::uint64_t, std::uint32_t>> result;
  for (const v1::SetpointBatch& batch : batches) {
    EXPECT_EQ(batch.path_position_mm_size(), batch.position_mm(0).values_size());
    EXPECT_EQ(batch.segment_size(), batch.position_mm(0).values_size());
    EXPECT_EQ(batch.line_size(), batch.position_mm(0).values_size());
    for (int i = 0; i < batch.segment_size(); ++i) {
      result.emplace_back(batch.path_position_mm(i), batch.segment(i), batch.line(i));
    }
  }
  return result;
}

// What is switched, and when.
std::vector<std::string> markers(const std::vector<v1::SetpointBatch>& batches) {
  std::vector<std::string> result;
  for (const v1::SetpointBatch& batch : batches) {
    for (const v1::MarkerAt& marker : batch.markers()) {
      EXPECT_GE(marker.tick(), batch.first_index());
      EXPECT_LT(marker.tick(), batch.first_index() + static_cast<std::uint64_t>(batch.position_mm(0).values_size()));
      result.push_back(marker.ShortDebugString());
    }
  }
  return result;
}

class Live : public ::testing::Test {
 protected:
  // That the messages give the same as a stored plan of `whole`.
  void expect_same(const Messages& whole, const Messages& pieces, v1::LiveOutput output) {
    for (const v1::Channel channel : {v1::CHANNEL_VELOCITY, v1::CHANNEL_ACCELERATION, v1::CHANNEL_JERK,
                                      v1::CHANNEL_PATH_POSITION, v1::CHANNEL_SEGMENT, v1::CHANNEL_LINE}) {
      output.add_channels(channel);
    }
    output.set_corners(true);
    const auto stored = server_.create(whole);
    ASSERT_TRUE(stored.status.ok()) << stored.status.error_message();
    auto asked = setpoints(stored.message.name(), output.period_s());
    *asked.mutable_channels() = output.channels();
    const auto expected = server_.stream(asked).message;
    const auto corners = server_.corners(stored.message.name()).message;

    const LiveAnswer answer = LiveClient(server_).exchange(live(pieces, output));
    ASSERT_TRUE(answer.status.ok()) << answer.status.error_message();
    ASSERT_EQ(answer.plans.size(), 1U);
    EXPECT_EQ(content(answer.plans[0]), content(stored.message));
    for (int axis = 0; axis < expected[0].position_mm_size(); ++axis) {
      for (const Columns channel : kChannels) {
        EXPECT_EQ(column(answer.setpoints, axis, channel), column(expected, axis, channel));
      }
    }
    EXPECT_EQ(places(answer.setpoints), places(expected));
    EXPECT_EQ(markers(answer.setpoints), markers(expected));
    EXPECT_EQ(markers(expected).size(), stored.message.summary().marker_count());
    expect_consecutive(answer.setpoints, output);
    EXPECT_EQ(answer.setpoints.back().setpoint_count(), expected.back().setpoint_count());
    ASSERT_EQ(answer.corners.size(), corners.size());
    for (std::size_t i = 0; i < corners.size(); ++i) {
      ASSERT_EQ(answer.corners[i].SerializeAsString(), corners[i].SerializeAsString()) << i;
    }
  }

  static void expect_consecutive(const std::vector<v1::SetpointBatch>& batches, const v1::LiveOutput& output) {
    std::uint64_t next = 0;
    for (const v1::SetpointBatch& batch : batches) {
      const bool last = &batch == &batches.back();
      EXPECT_EQ(batch.first_index(), next);
      EXPECT_EQ(batch.end_of_path(), last);
      EXPECT_EQ(batch.setpoint_count() != 0, last);
      const int size = batch.position_mm(0).values_size();
      EXPECT_GT(size, 0);
      EXPECT_LE(size, static_cast<int>(output.has_batch_size() ? output.batch_size() : 4096));
      next += static_cast<std::uint64_t>(size);
    }
    EXPECT_EQ(batches.back().setpoint_count(), next);
  }

  TestServer server_;
};

TEST_F(Live, GivesTheSameAsTheStoredPlanOfAZigzag) {
  const auto numbers = zigzag(1500);
  for (const std::size_t piece : {1500, 7, 1}) expect_same(points(numbers, 1500), points(numbers, piece), every(0.001));
}

TEST_F(Live, GivesTheSameAsTheStoredPlanOfADenseCircle) {
  const auto numbers = circle(8000);
  for (const std::size_t piece : {8000, 501, 3}) {
    expect_same(points(numbers, 8000), points(numbers, piece), every(0.001));
  }
}

TEST_F(Live, GivesTheSameAsTheStoredPlanOfAProgram) {
  for (const std::size_t piece : {kProgram.size(), std::size_t{50}, std::size_t{3}, std::size_t{1}}) {
    expect_same(program(kProgram.size()), program(piece), every(0.001));
  }
}

TEST_F(Live, GivesTheSameAtEveryPeriodAndBatchSize) {
  const auto numbers = circle(1000);
  const Messages whole = points(numbers, 1000), pieces = points(numbers, 100);
  for (const double period : {1e-4, 0.0007, 0.01, 1.0, 10.0}) {
    for (const std::uint32_t size : {1U, 100U, 32768U}) {
      v1::LiveOutput output = every(period);
      output.set_batch_size(size);
      expect_same(whole, pieces, output);
    }
  }
}

TEST_F(Live, GivesTheSameOfRandomPaths) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    SCOPED_TRACE(seed);
    const auto numbers = random_walk(seed);
    expect_same(points(numbers, numbers.size()), points(numbers, 1 + seed * 5), every(0.002));
  }
}

TEST_F(Live, StopsAndDwellsAreTaken) {
  const auto with_stops = [](std::vector<double> numbers, std::vector<std::uint32_t> stops) {
    v1::PathChunk chunk = path(numbers);
    for (const std::uint32_t point : stops) {
      v1::Stop& stop = *chunk.add_stops();
      stop.set_point(point);
      stop.set_dwell_s(0.25);
    }
    return request(chunk);
  };
  expect_same(
      {request(options()), with_stops({0, 0, 10, 0, 10, 10, 20, 10}, {0, 2, 3})},
      {request(options()), with_stops({0, 0}, {0}), with_stops({10, 0, 10, 10}, {1}), with_stops({20, 10}, {0})},
      every(0.001));
}

TEST_F(Live, GoesOnAndEndsInMotion) {
  v1::PlanOptions moving = options();
  moving.set_start_speed_mm_s(40);
  moving.set_start_acceleration_mm_s2(-500);
  moving.set_end_speed_mm_s(30);
  const Messages messages = {request(moving), request(path(zigzag(40)))};
  expect_same(messages, messages, every(0.001));
}

TEST_F(Live, PlanIsNotKept) {
  const LiveAnswer answer = LiveClient(server_).exchange(live({request(options()), request(right_angle())}, every(1)));
  ASSERT_EQ(answer.plans.size(), 1U);
  EXPECT_EQ(server_.get(answer.plans[0].name()).status.error_code(), grpc::StatusCode::NOT_FOUND);
}

TEST_F(Live, CornersComeOnlyIfTheyAreWanted) {
  const LiveAnswer answer = LiveClient(server_).exchange(live({request(options()), request(right_angle())}, every(1)));
  EXPECT_TRUE(answer.corners.empty());
}

TEST_F(Live, SetpointsComeWhileThePathIsStillOnItsWay) {
  LiveClient client(server_);
  const auto messages = live(points(circle(4000), 500), every(0.001));
  v1::PlanLiveResponse response;
  for (std::size_t i = 0; i + 1 < messages.size(); ++i) ASSERT_TRUE(client.write(messages[i]));
  ASSERT_TRUE(client.read(response));
  EXPECT_EQ(response.setpoints().first_index(), 0U);
  EXPECT_EQ(response.setpoints().setpoint_count(), 0U);
  EXPECT_FALSE(response.setpoints().end_of_path());
  ASSERT_TRUE(client.write(messages.back()));
  client.end_path();
  const LiveAnswer rest = client.read_all();
  EXPECT_TRUE(rest.status.ok()) << rest.status.error_message();
  EXPECT_EQ(rest.plans.size(), 1U);
}

TEST_F(Live, SenderMayBeSlow) {
  LiveClient client(server_);
  std::jthread writer([&] {
    for (const auto& message : live(points(circle(2000), 400), every(0.001))) {
      client.write(message);
      std::this_thread::sleep_for(std::chrono::milliseconds(100));
    }
    client.end_path();
  });
  const LiveAnswer answer = client.read_all();
  EXPECT_TRUE(answer.status.ok()) << answer.status.error_message();
  EXPECT_TRUE(answer.setpoints.back().end_of_path());
}

}  // namespace
}  // namespace kcs::service::test
