#include "server/service/live_setpoints.h"

#include <spdlog/fmt/fmt.h>

#include <utility>

namespace kcs::service {
namespace {

double checked_period(double period) {
  Violations violations;
  violations.check_range("output.period_s", period, kMinPeriod, kMaxPeriod, "s");
  violations.refuse();
  return period;
}

}  // namespace

LiveSetpoints::LiveSetpoints(const v1::LiveOutput& output, std::size_t axes, SendLive send)
    : columns_(output, "output.", axes),
      period_(checked_period(output.period_s())),
      sampler_(period_),
      send_(std::move(send)) {}

void LiveSetpoints::begin(const motion::Vector& start) {
  if (columns_.has_places()) places_.emplace(start, period_);
}

void LiveSetpoints::add(const planning::Segment& segment) {
  if (places_) places_->add(segment.end, segment.line);
}

void LiveSetpoints::add(const motion::Phase& phase) {
  if (phase.end_time() / period_ > kMostSetpoints) {
    refuse("output.period_s",
           fmt::format("cuts a motion of {} s into too many setpoints: give a longer one", phase.end_time()));
  }
  sampler_.add(phase);
  if (places_) places_->add(phase);
  put_settled();
}

void LiveSetpoints::finish(const motion::State& end) {
  sampler_.finish(end);
  put_settled();
  flush();
}

void LiveSetpoints::flush() {
  if (size_ == 0) return;
  v1::SetpointBatch& batch = *response_.mutable_setpoints();
  SetpointColumns::cut(batch, size_);
  batch.set_first_index(sampler_.given() - size_);
  batch.set_end_of_path(sampler_.ended());
  batch.set_setpoint_count(sampler_.ended() ? sampler_.given() : 0);
  send_(response_);
  size_ = 0;
}

// Those that come with the last setpoint that was given.
void LiveSetpoints::put_markers() {
  const std::uint64_t index = sampler_.given() - 1;
  while (!markers_.empty() && (sampler_.ended() || setpoint_of(markers_.front(), period_) <= index)) {
    add_marker(index, markers_.front().marker, *response_.mutable_setpoints());
    markers_.pop_front();
  }
}

void LiveSetpoints::put_settled() {
  while (const auto setpoint = sampler_.next()) {
    if (size_ == 0) columns_.begin(*response_.mutable_setpoints(), columns_.batch_size());
    columns_.set(size_, *setpoint);
    if (places_) columns_.set(size_, sampler_.ended() ? places_->end() : places_->next(), places_->path());
    ++size_;
    put_markers();
    if (size_ == columns_.batch_size()) flush();
  }
}

}  // namespace kcs::service
