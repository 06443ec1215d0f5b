#include "tests/unit/gateway/machine/straight_motion.h"

#include <algorithm>
#include <cmath>

#include "client/gateway/machine/batch_check.h"

namespace kcs::gateway {
namespace {

constexpr test::LineLimits kLimits = {.velocity = 100, .acceleration = 1000, .jerk = 20'000};

std::uint64_t periods(double seconds, double period) {
  return static_cast<std::uint64_t>(std::ceil(seconds / period - 1e-9));
}

void add(google::protobuf::RepeatedPtrField<v1::Column>& columns, double way) {
  const Vector point = StraightMotion::point(way);
  for (int axis = 0; axis < columns.size(); ++axis) columns[axis].add_values(point[axis]);
}

}  // namespace

kcs_player_profile test_profile(double period_s) {
  return {.axes = 2,
          .period_s = period_s,
          .velocity_mm_s = {kLimits.velocity, kLimits.velocity, 0},
          .acceleration_mm_s2 = {kLimits.acceleration, kLimits.acceleration, 0},
          .jerk_mm_s3 = {kLimits.jerk, kLimits.jerk, 0},
          .following_error_mm = {5, 5, 0}};
}

StraightMotion::StraightMotion(double from_mm, double to_mm, double period_s, int axes)
    : to_(to_mm),
      period_(period_s),
      axes_(axes),
      motion_(to_mm > from_mm ? test::LineMotion::travel(from_mm, to_mm, kLimits) : test::LineMotion({.place = to_mm})),
      size_(std::max<std::uint64_t>(1, periods(motion_.duration_s(), period_s))) {}

test::LineState StraightMotion::at(std::uint64_t setpoint) const {
  if (setpoint + 1 >= size_) return {.place = to_};
  return motion_.at(static_cast<double>(setpoint + 1) * period_);
}

v1::MotionBatch StraightMotion::batch(const std::string& run, std::uint64_t branch, std::uint64_t first_tick,
                                      std::uint64_t first, std::uint64_t count) const {
  v1::MotionBatch batch;
  batch.set_run(run);
  batch.set_branch(branch);
  batch.set_first_tick(first_tick);
  for (int axis = 0; axis < axes_; ++axis) {
    batch.add_position_mm();
    batch.add_tail_mm();
  }
  const std::uint64_t last = std::min(first + count, size_) - 1;
  for (std::uint64_t i = first; i <= last; ++i) add(*batch.mutable_position_mm(), at(i).place);
  const test::LineState end = at(last);
  batch.mutable_end()->set_plan_time_s(end.place);
  batch.mutable_end()->set_rate(end.velocity);
  batch.mutable_end()->set_rate_change_s(end.acceleration);
  batch.set_end_of_plan(last + 1 == size_);
  batch.set_tail_end_s(end.place);
  if (!batch.end_of_plan()) {
    const test::LineMotion stop = test::LineMotion::stop(end, kLimits);
    const double rest = stop.at(stop.duration_s()).place;
    const std::uint64_t tail = periods(stop.duration_s(), period_);
    for (std::uint64_t i = 1; i <= tail; ++i) {
      add(*batch.mutable_tail_mm(), i == tail ? rest : stop.at(static_cast<double>(i) * period_).place);
    }
    batch.set_tail_end_s(rest);
  }
  batch.set_checksum(checksum_of(batch));
  return batch;
}

}  // namespace kcs::gateway
