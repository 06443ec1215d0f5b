#include "server/service/setpoint_stream.h"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>

#include "server/service/violations.h"

namespace kcs::service {
namespace {

using Columns = google::protobuf::RepeatedPtrField<v1::Column>;

constexpr double kMinPeriod = 1e-5, kMaxPeriod = 10;  // s
constexpr double kMostSetpoints = 9007199254740992;   // 2^53: up to here i × period has an exact i
constexpr std::uint32_t kBatchSize = 4096, kMaxBatchSize = 32768;

// The numbers of `axes` columns of `size` entries each.
std::array<double*, 3> resized(Columns& columns, std::size_t axes, int size) {
  std::array<double*, 3> numbers{};
  for (std::size_t axis = 0; axis < axes; ++axis) {
    const int column = static_cast<int>(axis);
    auto& values = *(column < columns.size() ? columns.Mutable(column) : columns.Add())->mutable_values();
    values.Resize(size, 0);
    numbers[axis] = values.mutable_data();
  }
  return numbers;
}

double checked_period(const jobs::KeptPlan& kept, double period) {
  Violations violations;
  if (violations.check_range("period_s", period, kMinPeriod, kMaxPeriod, "s") &&
      kept.plan.trajectory.duration() / period > kMostSetpoints) {
    violations.add("period_s", fmt::format("cuts a plan of {} s into too many setpoints: give a longer one",
                                           kept.plan.trajectory.duration()));
  }
  violations.refuse();
  return period;
}

}  // namespace

SetpointStream::SetpointStream(jobs::PlanPointer plan, const v1::StreamSetpointsRequest& request)
    : plan_(std::move(plan)),
      sampler_(plan_->plan.trajectory, checked_period(*plan_, request.period_s())),
      next_(request.first_index()),
      batch_size_(request.has_batch_size() ? request.batch_size() : kBatchSize) {
  Violations violations;
  const std::uint64_t last = sampler_.count() - 1;
  end_ = !request.has_last_index() ? last + 1 : std::min(request.last_index(), last) + 1;
  if (next_ > last) {
    violations.add("first_index", fmt::format("{} is beyond the plan's last setpoint: give 0 to {}", next_, last));
  } else if (next_ >= end_) {
    violations.add("last_index", fmt::format("{} is before first_index = {}", request.last_index(), next_));
  }
  if (batch_size_ < 1 || batch_size_ > kMaxBatchSize) {
    violations.add("batch_size", fmt::format("{} is out of range: give 1 to {}", batch_size_, kMaxBatchSize));
  }
  for (int i = 0; i < request.channels_size(); ++i) {
    switch (request.channels(i)) {
      case v1::CHANNEL_POSITION:
        break;
      case v1::CHANNEL_VELOCITY:
        velocity_ = true;
        break;
      case v1::CHANNEL_ACCELERATION:
        acceleration_ = true;
        break;
      case v1::CHANNEL_JERK:
        jerk_ = true;
        break;
      default:
        violations.add(fmt::format("channels[{}]", i),
                       fmt::format("{} is no channel: give position, velocity, acceleration or jerk",
                                   static_cast<int>(request.channels(i))));
    }
  }
  violations.refuse();
}

bool SetpointStream::next(v1::SetpointBatch& batch) {
  if (next_ == end_) return false;
  const std::size_t axes = plan_->options.planning.limits.axes;
  const std::uint64_t size = std::min(batch_size_, end_ - next_);
  const auto columns = [&](Columns* field, bool wanted) {
    return resized(*field, wanted ? axes : 0, static_cast<int>(size));
  };
  const auto position = columns(batch.mutable_position_mm(), true);
  const auto velocity = columns(batch.mutable_velocity_mm_s(), velocity_);
  const auto acceleration = columns(batch.mutable_acceleration_mm_s2(), acceleration_);
  const auto jerk = columns(batch.mutable_jerk_mm_s3(), jerk_);
  for (std::uint64_t i = 0; i < size; ++i) {
    const motion::Setpoint setpoint = sampler_.at(next_ + i);
    const auto store = [axes, i](const std::array<double*, 3>& numbers, const motion::Vector& value) {
      for (std::size_t axis = 0; axis < axes; ++axis) numbers[axis][i] = value[static_cast<Eigen::Index>(axis)];
    };
    store(position, setpoint.state.position);
    if (velocity_) store(velocity, setpoint.state.velocity);
    if (acceleration_) store(acceleration, setpoint.state.acceleration);
    if (jerk_) store(jerk, setpoint.jerk);
  }
  batch.set_first_index(next_);
  batch.set_setpoint_count(sampler_.count());
  next_ += size;
  batch.set_end_of_path(next_ == sampler_.count());
  return true;
}

}  // namespace kcs::service
