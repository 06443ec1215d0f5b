#include "server/service/setpoint_columns.h"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cmath>

#include "server/service/encode.h"

namespace kcs::service {
namespace {

using Columns = google::protobuf::RepeatedPtrField<v1::Column>;

template <typename Number>
Number* resized(google::protobuf::RepeatedField<Number>& column, int size) {
  column.Resize(size, 0);
  return column.mutable_data();
}

// The numbers of `axes` columns of `size` entries each.
std::array<double*, 3> resized(Columns& columns, std::size_t axes, int size) {
  std::array<double*, 3> numbers{};
  for (std::size_t axis = 0; axis < axes; ++axis) {
    const int column = static_cast<int>(axis);
    numbers[axis] =
        resized(*(column < columns.size() ? columns.Mutable(column) : columns.Add())->mutable_values(), size);
  }
  return numbers;
}

template <typename Number>
void truncate(google::protobuf::RepeatedField<Number>& column, int size) {
  if (column.size() > size) column.Truncate(size);
}

void truncate(Columns& columns, int size) {
  for (v1::Column& column : columns) truncate(*column.mutable_values(), size);
}

}  // namespace

void SetpointColumns::begin(v1::SetpointBatch& batch, std::uint64_t size) {
  const auto columns = [&](Columns* field, bool wanted) {
    return wanted ? resized(*field, axes_, static_cast<int>(size)) : Numbers{};
  };
  position_ = columns(batch.mutable_position_mm(), true);
  velocity_ = columns(batch.mutable_velocity_mm_s(), has_velocity_);
  acceleration_ = columns(batch.mutable_acceleration_mm_s2(), has_acceleration_);
  jerk_ = columns(batch.mutable_jerk_mm_s3(), has_jerk_);
  batch.clear_markers();
  if (has_path_position_) path_position_ = resized(*batch.mutable_path_position_mm(), static_cast<int>(size));
  if (has_segment_) segment_ = resized(*batch.mutable_segment(), static_cast<int>(size));
  if (has_line_) line_ = resized(*batch.mutable_line(), static_cast<int>(size));
}

void SetpointColumns::set(std::uint64_t index, const motion::Setpoint& setpoint) {
  const auto store = [&](const Numbers& numbers, const motion::Vector& value) {
    for (std::size_t axis = 0; axis < axes_; ++axis) numbers[axis][index] = value[static_cast<Eigen::Index>(axis)];
  };
  store(position_, setpoint.state.position);
  if (has_velocity_) store(velocity_, setpoint.state.velocity);
  if (has_acceleration_) store(acceleration_, setpoint.state.acceleration);
  if (has_jerk_) store(jerk_, setpoint.jerk);
}

void SetpointColumns::set(std::uint64_t index, const motion::Place& place, const motion::Path& path) {
  if (has_path_position_) path_position_[index] = place.way;
  if (has_segment_) segment_[index] = place.segment;
  if (has_line_) line_[index] = path.line_of(place.segment);
}

void SetpointColumns::cut(v1::SetpointBatch& batch, std::uint64_t size) {
  for (Columns* columns : {batch.mutable_position_mm(), batch.mutable_velocity_mm_s(),
                           batch.mutable_acceleration_mm_s2(), batch.mutable_jerk_mm_s3()}) {
    truncate(*columns, static_cast<int>(size));
  }
  truncate(*batch.mutable_path_position_mm(), static_cast<int>(size));
  truncate(*batch.mutable_segment(), static_cast<int>(size));
  truncate(*batch.mutable_line(), static_cast<int>(size));
}

std::uint64_t setpoint_of(const planning::MarkerAt& marker, double period) {
  constexpr double kRounding = 1e-6;  // of a period
  return static_cast<std::uint64_t>(std::max(0.0, std::ceil(marker.time / period - kRounding)));
}

void add_marker(std::uint64_t setpoint, const planning::Marker& marker, v1::SetpointBatch& batch) {
  v1::MarkerAt& entry = *batch.add_markers();
  entry.set_tick(setpoint);
  encode_marker(marker, *entry.mutable_marker());
}

void SetpointColumns::check_batch_size(const std::string& parent, Violations& violations) const {
  if (batch_size_ >= 1 && batch_size_ <= kMaxBatchSize) return;
  violations.add(parent + "batch_size", fmt::format("{} is out of range: give 1 to {}", batch_size_, kMaxBatchSize));
}

void SetpointColumns::add_channel(v1::Channel channel, const std::string& parent, int index, Violations& violations) {
  switch (channel) {
    case v1::CHANNEL_POSITION:
      break;
    case v1::CHANNEL_VELOCITY:
      has_velocity_ = true;
      break;
    case v1::CHANNEL_ACCELERATION:
      has_acceleration_ = true;
      break;
    case v1::CHANNEL_JERK:
      has_jerk_ = true;
      break;
    case v1::CHANNEL_PATH_POSITION:
      has_path_position_ = true;
      break;
    case v1::CHANNEL_SEGMENT:
      has_segment_ = true;
      break;
    case v1::CHANNEL_LINE:
      has_line_ = true;
      break;
    default:
      violations.add(fmt::format("{}channels[{}]", parent, index),
                     fmt::format("{} is no channel: give position, velocity, acceleration, jerk, path position, "
                                 "segment or line",
                                 static_cast<int>(channel)));
  }
}

}  // namespace kcs::service
