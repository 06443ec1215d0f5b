// StreamSetpoints: which setpoints come, and that they are the same whenever they come.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "tests/service/test_server.h"

namespace kcs::service::test {
namespace {

using Columns = google::protobuf::RepeatedPtrField<v1::Column>;

constexpr v1::Channel kAllChannels[] = {v1::CHANNEL_VELOCITY,      v1::CHANNEL_ACCELERATION, v1::CHANNEL_JERK,
                                        v1::CHANNEL_PATH_POSITION, v1::CHANNEL_SEGMENT,      v1::CHANNEL_LINE};

template <typename Numbers>
void append(const Numbers& from, int skip, Numbers& to) {
  for (int i = skip; i < from.size(); ++i) to.Add(from[i]);
}

void append(const Columns& from, int skip, Columns& to) {
  while (to.size() < from.size()) to.Add();
  for (int axis = 0; axis < from.size(); ++axis) append(from[axis].values(), skip, *to[axis].mutable_values());
}

// The numbers of all batches from an index on, as bytes.
std::string numbers(const std::vector<v1::SetpointBatch>& batches, std::uint64_t first) {
  v1::SetpointBatch all;
  for (const v1::SetpointBatch& batch : batches) {
    const int skip = static_cast<int>(std::max(first, batch.first_index()) - batch.first_index());
    append(batch.position_mm(), skip, *all.mutable_position_mm());
    append(batch.velocity_mm_s(), skip, *all.mutable_velocity_mm_s());
    append(batch.acceleration_mm_s2(), skip, *all.mutable_acceleration_mm_s2());
    append(batch.jerk_mm_s3(), skip, *all.mutable_jerk_mm_s3());
    append(batch.path_position_mm(), skip, *all.mutable_path_position_mm());
    append(batch.segment(), skip, *all.mutable_segment());
    append(batch.line(), skip, *all.mutable_line());
  }
  return all.SerializeAsString();
}

class Setpoints : public ::testing::Test {
 protected:
  void SetUp() override {
    v1::PathChunk chunk = path({0, 0, 0, 10, 0, 1, 10, 10, 2, -3, 4, 0.1});
    for (const std::uint32_t line : {1U, 20U, 21U, 7U}) chunk.add_line(line);
    const auto plan = server_.create({request(options(3)), request(chunk)});
    ASSERT_TRUE(plan.status.ok()) << plan.status.error_message();
    plan_ = plan.message;
  }

  std::vector<v1::SetpointBatch> stream(const v1::StreamSetpointsRequest& request) {
    auto answer = server_.stream(request);
    EXPECT_TRUE(answer.status.ok()) << answer.status.error_message();
    return answer.message;
  }

  v1::StreamSetpointsRequest every_millisecond() const { return setpoints(plan_.name(), 0.001); }
  v1::StreamSetpointsRequest with_all_channels() const {
    auto request = every_millisecond();
    for (const v1::Channel channel : kAllChannels) request.add_channels(channel);
    return request;
  }

  TestServer server_;
  v1::Plan plan_;
};

TEST_F(Setpoints, GoFromTheStartToTheExactEnd) {
  const auto batches = stream(every_millisecond());
  const auto count = static_cast<std::size_t>(std::ceil(plan_.summary().cycle_time_s() / 0.001)) + 1;
  for (int axis = 0; axis < 3; ++axis) {
    const auto numbers = column(batches, axis);
    ASSERT_EQ(numbers.size(), count);
    EXPECT_EQ(numbers.front(), plan_.summary().start_mm(axis));
    EXPECT_EQ(numbers.back(), plan_.summary().end_mm(axis));
  }
  EXPECT_EQ(batches.back().setpoint_count(), count);
  EXPECT_TRUE(batches.back().end_of_path());
}

TEST_F(Setpoints, BatchesAreConsecutiveAndOfTheSizeAskedFor) {
  auto request = every_millisecond();
  request.set_batch_size(7);
  std::uint64_t next = 0;
  const auto batches = stream(request);
  ASSERT_GT(batches.size(), 2U);
  for (const v1::SetpointBatch& batch : batches) {
    const bool last = &batch == &batches.back();
    EXPECT_EQ(batch.first_index(), next);
    EXPECT_EQ(batch.end_of_path(), last);
    EXPECT_EQ(batch.setpoint_count(), batches.back().setpoint_count());
    if (!last) {
      EXPECT_EQ(batch.position_mm(0).values_size(), 7);
    }
    next += static_cast<std::uint64_t>(batch.position_mm(0).values_size());
  }
  EXPECT_EQ(next, batches.back().setpoint_count());
}

TEST_F(Setpoints, DoNotDependOnTheBatchSize) {
  const std::string expected = numbers(stream(with_all_channels()), 0);
  for (const std::uint32_t size : {1U, 13U, 32768U}) {
    auto request = with_all_channels();
    request.set_batch_size(size);
    EXPECT_TRUE(numbers(stream(request), 0) == expected) << size;
  }
}

TEST_F(Setpoints, ResumeAnywhereWithTheSameBytes) {
  auto request = with_all_channels();
  request.set_batch_size(50);
  const auto whole = stream(request);
  for (std::uint64_t first = 0; first < whole.back().setpoint_count(); first += 17) {
    request.set_first_index(first);
    const auto rest = stream(request);
    EXPECT_EQ(rest.front().first_index(), first);
    EXPECT_TRUE(numbers(rest, first) == numbers(whole, first)) << first;
  }
}

TEST_F(Setpoints, EndAtTheLastIndexAskedFor) {
  const auto whole = column(stream(every_millisecond()), 0);
  auto request = every_millisecond();
  request.set_first_index(10);
  request.set_last_index(20);
  const auto part = stream(request);
  EXPECT_EQ(column(part, 0), std::vector<double>(whole.begin() + 10, whole.begin() + 21));
  EXPECT_FALSE(part.back().end_of_path());
  request.set_last_index(1'000'000'000'000);
  EXPECT_EQ(column(stream(request), 0).size(), whole.size() - 10);
}

TEST_F(Setpoints, CarryTheChannelsAskedForAndNoOthers) {
  auto request = every_millisecond();
  request.add_channels(v1::CHANNEL_VELOCITY);
  request.add_channels(v1::CHANNEL_JERK);
  request.add_channels(v1::CHANNEL_POSITION);
  request.add_channels(v1::CHANNEL_JERK);
  for (const v1::SetpointBatch& batch : stream(request)) {
    EXPECT_EQ(batch.position_mm_size(), 3);
    EXPECT_EQ(batch.velocity_mm_s_size(), 3);
    EXPECT_EQ(batch.acceleration_mm_s2_size(), 0);
    EXPECT_EQ(batch.jerk_mm_s3_size(), 3);
    EXPECT_EQ(batch.jerk_mm_s3(2).values_size(), batch.position_mm(0).values_size());
    EXPECT_EQ(batch.path_position_mm_size(), 0);
    EXPECT_EQ(batch.segment_size(), 0);
    EXPECT_EQ(batch.line_size(), 0);
  }
}

TEST_F(Setpoints, ChannelsAreTheDerivativesOfThePosition) {
  constexpr double kPeriod = 1e-4;
  auto request = setpoints(plan_.name(), kPeriod);
  request.add_channels(v1::CHANNEL_VELOCITY);
  request.add_channels(v1::CHANNEL_ACCELERATION);
  const auto batches = stream(request);
  const auto position = column(batches, 0);
  const auto velocity = column(batches, 0, &v1::SetpointBatch::velocity_mm_s);
  const auto acceleration = column(batches, 0, &v1::SetpointBatch::acceleration_mm_s2);
  for (std::size_t i = 1; i + 2 < position.size(); ++i) {
    EXPECT_NEAR((position[i + 1] - position[i - 1]) / (2 * kPeriod), velocity[i], 2e5 * kPeriod * kPeriod);
    EXPECT_NEAR((velocity[i + 1] - velocity[i - 1]) / (2 * kPeriod), acceleration[i], 2e5 * kPeriod);
  }
  EXPECT_EQ(velocity.back(), 0);
  EXPECT_EQ(acceleration.back(), 0);
}

TEST_F(Setpoints, FollowThePathToItsEnd) {
  double way = 0;
  std::uint64_t segment = 0;
  for (const v1::SetpointBatch& batch : stream(with_all_channels())) {
    ASSERT_EQ(batch.path_position_mm_size(), batch.position_mm(0).values_size());
    ASSERT_EQ(batch.segment_size(), batch.position_mm(0).values_size());
    for (int i = 0; i < batch.segment_size(); ++i) {
      EXPECT_GE(batch.path_position_mm(i), way - 1e-9);
      EXPECT_GE(batch.segment(i), segment);
      way = batch.path_position_mm(i);
      segment = batch.segment(i);
    }
  }
  EXPECT_EQ(way, plan_.summary().path_length_mm());
  EXPECT_EQ(segment + 1, plan_.summary().segment_count());
}

TEST_F(Setpoints, PeriodLongerThanThePlanGivesItsTwoEnds) {
  const auto numbers = column(stream(setpoints(plan_.name(), 10)), 0);
  EXPECT_EQ(numbers, (std::vector<double>{0, -3}));
}

TEST_F(Setpoints, GoOnWhenThePlanIsDeletedMeanwhile) {
  auto request = setpoints(plan_.name(), 1e-5);
  request.set_batch_size(16);
  Call call;
  const auto reader = server_.stub().StreamSetpoints(&call, request);
  v1::SetpointBatch batch;
  ASSERT_TRUE(reader->Read(&batch));
  EXPECT_TRUE(server_.remove(plan_.name()).ok());
  while (reader->Read(&batch)) continue;
  EXPECT_TRUE(reader->Finish().ok());
  EXPECT_TRUE(batch.end_of_path());
}

TEST_F(Setpoints, RefuseWhatCannotBeServed) {
  const auto refused = [this](const std::string& field, auto change) {
    auto request = every_millisecond();
    change(request);
    EXPECT_TRUE(refuses_field(server_.stream(request).status, field));
  };
  for (const double period : {0.0, -1.0, 9e-6, 11.0, double(NAN), double(INFINITY), 1e308}) {
    refused("period_s", [period](auto& request) { request.set_period_s(period); });
  }
  refused("first_index", [](auto& request) { request.set_first_index(1'000'000); });
  refused("first_index", [](auto& request) { request.set_first_index(~0ULL); });
  refused("last_index", [](auto& request) {
    request.set_first_index(20);
    request.set_last_index(19);
  });
  refused("batch_size", [](auto& request) { request.set_batch_size(0); });
  refused("batch_size", [](auto& request) { request.set_batch_size(65537); });
  refused("channels[1]", [](auto& request) {
    request.add_channels(v1::CHANNEL_JERK);
    request.add_channels(v1::CHANNEL_UNSPECIFIED);
  });
  refused("channels[0]", [](auto& request) { request.add_channels(static_cast<v1::Channel>(99)); });
  for (const double lead : {-1e-9, 3601.0, double(NAN), double(INFINITY)}) {
    refused("lead_s", [lead](auto& request) { request.set_lead_s(lead); });
  }
  refused("name", [](auto& request) { request.clear_name(); });
  EXPECT_FALSE(stream(every_millisecond()).empty());
}

TEST_F(Setpoints, CornersAreToldInTheOrderOfThePath) {
  const auto corners = server_.corners(plan_.name());
  ASSERT_TRUE(corners.status.ok());
  ASSERT_EQ(corners.message.size(), 2U);
  for (std::size_t i = 0; i < corners.message.size(); ++i) {
    const v1::Corner& corner = corners.message[i];
    EXPECT_EQ(corner.segment(), i);
    EXPECT_GT(corner.angle_deg(), 0);
    EXPECT_LT(corner.angle_deg(), 180);
    EXPECT_GT(corner.speed_mm_s(), 0);
    EXPECT_LE(corner.deviation_mm(), 0.01);
    EXPECT_EQ(corner.deviation_mm(), corner.contour_error_mm());
    EXPECT_EQ(corner.point_mm_size(), 3);
  }
  EXPECT_EQ(corners.message[1].point_mm(2), 2);
}

TEST(Markers, ComeWithTheirSetpointHoweverTheStreamIsCut) {
  TestServer server;
  v1::PathChunk chunk = path({0, 0, 10, 0, 20, 0, 20, 10});
  for (std::uint32_t point = 0; point < 4; ++point) {
    v1::PathMarker& marker = *chunk.add_markers();
    marker.set_point(point);
    marker.mutable_marker()->set_kind(v1::MARKER_KIND_SPINDLE_CLOCKWISE);
    marker.mutable_marker()->set_value(1000 + point);
  }
  const auto plan = server.create({request(options()), request(chunk)});
  ASSERT_TRUE(plan.status.ok()) << plan.status.error_message();
  EXPECT_EQ(plan.message.summary().marker_count(), 4u);
  EXPECT_EQ(plan.message.summary().exact_stop_count(), 0u);
  for (const std::uint32_t size : {1u, 7u, 32768u}) {
    auto asked = setpoints(plan.message.name(), 0.001);
    asked.set_batch_size(size);
    std::vector<double> speeds;
    for (const v1::SetpointBatch& batch : server.stream(asked).message) {
      for (const v1::MarkerAt& it : batch.markers()) {
        speeds.push_back(it.marker().value());
        ASSERT_GE(it.tick(), batch.first_index());
        const auto row = static_cast<int>(it.tick() - batch.first_index());
        ASSERT_LT(row, batch.position_mm(0).values_size());
        // 100 mm/s: no farther on than one setpoint, and the corner is cut by some micrometres.
        const double x = batch.position_mm(0).values(row), y = batch.position_mm(1).values(row);
        EXPECT_NEAR(x + y, 10 * (it.marker().value() - 1000), 0.15) << size;
      }
    }
    EXPECT_EQ(speeds, (std::vector<double>{1000, 1001, 1002, 1003})) << size;
  }
}

TEST(Markers, OfPointsAreRefusedWithTheirField) {
  TestServer server;
  const auto refusal = [&server](std::uint32_t point, v1::MarkerKind kind, double speed, int times) {
    v1::PathChunk chunk = path({0, 0, 10, 0});
    for (int i = 0; i < times; ++i) {
      v1::PathMarker& marker = *chunk.add_markers();
      marker.set_point(point);
      marker.mutable_marker()->set_kind(kind);
      marker.mutable_marker()->set_value(speed);
    }
    return server.create({request(options()), request(chunk)}).status.error_message();
  };
  EXPECT_EQ(refusal(1, v1::MARKER_KIND_FLOOD_ON, 0, 1), "");
  EXPECT_NE(refusal(2, v1::MARKER_KIND_FLOOD_ON, 0, 1).find("path.markers[0].point"), std::string::npos);
  EXPECT_NE(refusal(1, v1::MARKER_KIND_DWELL_BEGINS, 0, 1).find("path.markers[0].marker.kind"), std::string::npos);
  EXPECT_NE(refusal(1, v1::MARKER_KIND_SPINDLE_CLOCKWISE, -1, 1).find("path.markers[0].marker.value"),
            std::string::npos);
  EXPECT_NE(refusal(1, v1::MARKER_KIND_FLOOD_ON, 0, 2).find("path.markers[1].point"), std::string::npos);
}

}  // namespace
}  // namespace kcs::service::test
