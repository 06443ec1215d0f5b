#include "server/service/plan_records.h"

#include <google/protobuf/util/time_util.h>
#include <spdlog/fmt/fmt.h>

#include <chrono>
#include <stdexcept>

#include "server/service/status.h"
#include "server/service/violations.h"

namespace kcs::service {
namespace {

using google::protobuf::Timestamp;
using google::protobuf::util::TimeUtil;

// Calls READY and REFUSED what the store calls so; WAITING and PLANNING it does not tell apart.
store::State decode_state(v1::PlanState state) {
  switch (state) {
    case v1::PLAN_STATE_WAITING:
    case v1::PLAN_STATE_PLANNING:
      return store::State::kAccepted;
    case v1::PLAN_STATE_READY:
      return store::State::kFinished;
    case v1::PLAN_STATE_REFUSED:
      return store::State::kRefused;
    default:
      refuse("filter.state", fmt::format("is {}: give waiting, planning, ready or refused", static_cast<int>(state)));
  }
}

store::Time decode_time(const char* field, const Timestamp& time) {
  constexpr std::int32_t kMostNanoseconds = 999'999'999;
  const bool is_time = time.seconds() >= TimeUtil::kTimestampMinSeconds &&
                       time.seconds() <= TimeUtil::kTimestampMaxSeconds && time.nanos() >= 0 &&
                       time.nanos() <= kMostNanoseconds;
  if (!is_time) refuse(field, "is no time: give seconds of the years 1 to 9999 and nanoseconds up to 999999999");
  return store::Time(std::chrono::microseconds(TimeUtil::TimestampToMicroseconds(time)));
}

// Not a number passes no comparison: a list without an explanation.
double decode_cycle_time(const char* field, double seconds) {
  if (!(seconds >= 0)) refuse(field, fmt::format("is {} s: give 0 or more", seconds));
  return seconds;
}

}  // namespace

v1::Plan encode_record(const store::Record& record, v1::PlanState state) {
  v1::Plan plan;
  if (record.state == store::State::kFinished) {
    if (!plan.ParseFromString(record.outcome))
      throw std::runtime_error("what is stored of " + record.name + " is damaged");
    state = v1::PLAN_STATE_READY;
  }
  plan.set_name(record.name);
  plan.set_state(record.state == store::State::kRefused ? v1::PLAN_STATE_REFUSED : state);
  *plan.mutable_create_time() = TimeUtil::MicrosecondsToTimestamp(record.create_time.time_since_epoch().count());
  return plan;
}

const store::Record& require_not_refused(const store::Record& record) {
  if (record.state == store::State::kRefused) throw Refused{decode_refusal(record.outcome)};
  return record;
}

v1::PlanProgress encode_progress(const jobs::Progress& progress) {
  v1::PlanProgress message;
  message.set_state(progress.state == jobs::Progress::State::kWaiting ? v1::PLAN_STATE_WAITING
                                                                      : v1::PLAN_STATE_PLANNING);
  message.set_requests_ahead(static_cast<std::uint32_t>(progress.requests_ahead));
  message.set_segment_count(progress.segment_count);
  message.set_segments_planned(progress.segments_planned);
  return message;
}

v1::PlanProgress encode_progress(const v1::Plan& plan) {
  v1::PlanProgress message;
  message.set_state(v1::PLAN_STATE_READY);
  message.set_segment_count(plan.summary().segment_count());
  message.set_segments_planned(plan.summary().segment_count());
  return message;
}

store::Filter decode_filter(const v1::PlanFilter& filter) {
  store::Filter decoded;
  if (filter.has_machine_name()) decoded.machine_name = filter.machine_name();
  if (filter.state() != v1::PLAN_STATE_UNSPECIFIED) decoded.state = decode_state(filter.state());
  if (filter.has_created_from()) decoded.created_from = decode_time("filter.created_from", filter.created_from());
  if (filter.has_created_before()) {
    decoded.created_before = decode_time("filter.created_before", filter.created_before());
  }
  if (filter.has_cycle_time_at_least_s()) {
    decoded.cycle_time_at_least = decode_cycle_time("filter.cycle_time_at_least_s", filter.cycle_time_at_least_s());
  }
  if (filter.has_cycle_time_at_most_s()) {
    decoded.cycle_time_at_most = decode_cycle_time("filter.cycle_time_at_most_s", filter.cycle_time_at_most_s());
  }
  return decoded;
}

}  // namespace kcs::service
