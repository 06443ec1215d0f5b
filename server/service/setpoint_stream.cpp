#include "server/service/setpoint_stream.h"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "server/service/violations.h"

namespace kcs::service {
namespace {

// At the pace of the machine, s: a batch costs a processor some 60 µs, so that a thousand streams take 0.6 processors.
constexpr double kPacedBatch = 0.1;

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

std::uint32_t usual_batch_size(const v1::StreamSetpointsRequest& request) {
  if (!request.has_lead_s()) return kBatchSize;
  return static_cast<std::uint32_t>(std::clamp(std::round(kPacedBatch / request.period_s()), 1.0, double{kBatchSize}));
}

}  // namespace

SetpointStream::SetpointStream(jobs::PlanPointer plan, const v1::StreamSetpointsRequest& request)
    : plan_(std::move(plan)),
      period_(checked_period(*plan_, request.period_s())),
      sampler_(plan_->plan.trajectory, period_),
      columns_(request, "", plan_->options.planning.limits.axes, usual_batch_size(request)),
      next_(request.first_index()) {
  Violations violations;
  const std::uint64_t last = sampler_.count() - 1;
  end_ = !request.has_last_index() ? last + 1 : std::min(request.last_index(), last) + 1;
  if (next_ > last) {
    violations.add("first_index", fmt::format("{} is beyond the plan's last setpoint: give 0 to {}", next_, last));
  } else if (next_ >= end_) {
    violations.add("last_index", fmt::format("{} is before first_index = {}", request.last_index(), next_));
  }
  violations.refuse();
  const planning::Plan& kept = plan_->plan;
  if (columns_.has_places()) places_.emplace(kept.trajectory, kept.path, kept.milestones, period_);
}

bool SetpointStream::next(v1::SetpointBatch& batch) {
  if (next_ == end_) return false;
  const std::uint64_t size = std::min(columns_.batch_size(), end_ - next_);
  columns_.begin(batch, size);
  for (std::uint64_t i = 0; i < size; ++i) columns_.set(i, sampler_.at(next_ + i));
  for (std::uint64_t i = 0; places_ && i < size; ++i) columns_.set(i, places_->at(next_ + i), plan_->plan.path);
  batch.set_first_index(next_);
  batch.set_setpoint_count(sampler_.count());
  add_markers(size, batch);
  next_ += size;
  batch.set_end_of_path(next_ == sampler_.count());
  return true;
}

// Those that come with the next setpoints.
void SetpointStream::add_markers(std::uint64_t size, v1::SetpointBatch& batch) const {
  const auto setpoint = [this](const planning::MarkerAt& marker) {
    return std::min(setpoint_of(marker, period_), sampler_.count() - 1);
  };
  const std::vector<planning::MarkerAt>& markers = plan_->plan.markers;
  auto marker = std::partition_point(markers.begin(), markers.end(),
                                     [&](const planning::MarkerAt& it) { return setpoint(it) < next_; });
  for (; marker != markers.end() && setpoint(*marker) < next_ + size; ++marker) {
    add_marker(setpoint(*marker), marker->marker, batch);
  }
}

}  // namespace kcs::service
