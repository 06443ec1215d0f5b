#include "server/service/machine_messages.h"

#include <google/protobuf/util/time_util.h>
#include <spdlog/fmt/fmt.h>
#include <zlib.h>

#include <algorithm>
#include <bit>
#include <cctype>
#include <cmath>

#include "server/planning/range.h"
#include "server/service/decode.h"
#include "server/service/encode.h"
#include "server/service/printable.h"
#include "server/service/violations.h"

namespace kcs::service {
namespace {

using google::protobuf::RepeatedPtrField;
using google::protobuf::util::TimeUtil;

constexpr std::uint32_t kMostSetpoints = 1000, kMostTail = 1'000'000;
constexpr double kUsualBatch = 0.02, kUsualWindow = 0.25, kUsualReport = 0.02;  // s
// Beyond a report's age: how long an order takes to the machine, s.
constexpr double kWay = 0.01;
constexpr std::size_t kMostEnds = 10'000;
constexpr std::size_t kMostInstance = 64, kMostFault = 300;  // bytes

runs::ClockState decode_clock(const v1::PlanClock& clock) {
  const bool sound = clock.plan_time_s() >= 0 && std::isfinite(clock.plan_time_s()) && clock.rate() >= 0 &&
                     std::isfinite(clock.rate()) && std::isfinite(clock.rate_change_s());
  if (!sound) refuse("report.run", "has a clock that cannot be: give times and rates that are not negative");
  return {clock.plan_time_s(), clock.rate(), clock.rate_change_s()};
}

void encode_clock(const runs::ClockState& clock, v1::PlanClock& message) {
  message.set_plan_time_s(clock.plan_time);
  message.set_rate(clock.rate);
  message.set_rate_change_s(clock.rate_change);
}

motion::Vector decode_position(const google::protobuf::RepeatedField<double>& numbers, std::size_t axes) {
  motion::Vector position = motion::Vector::Zero();
  if (static_cast<std::size_t>(numbers.size()) != axes) {
    refuse("report", fmt::format("has a position of {} numbers: give {}, one per axis", numbers.size(), axes));
  }
  std::copy(numbers.begin(), numbers.end(), position.begin());
  if (!position.allFinite()) refuse("report", "has a position that is no number");
  return position;
}

void encode_position(const motion::Vector& position, std::size_t axes,
                     google::protobuf::RepeatedField<double>& numbers) {
  numbers.Assign(position.begin(), position.begin() + axes);
}

runs::MachinePosition decode_where(const v1::RunPosition& run) {
  runs::MachinePosition where{.branch = run.branch(), .played = run.ticks_played(), .committed = run.ticks_committed()};
  if (static_cast<std::size_t>(run.batch_ends_size()) > kMostEnds) refuse("report.run.batch_ends", "has too many");
  for (const v1::BatchEnd& end : run.batch_ends()) {
    if (!where.ends.empty() && end.tick() <= where.ends.back().tick) {
      refuse("report.run.batch_ends", "are not in order");
    }
    where.ends.push_back({end.tick(), decode_clock(end.clock())});
  }
  if (where.ends.empty() || where.ends.back().tick != run.ticks_held()) {
    where.ends.push_back({run.ticks_held(), decode_clock(run.end())});
  }
  return where;
}

runs::MachineState decode_state(v1::MachineState state) {
  switch (state) {
    case v1::MACHINE_STATE_SWITCHED_OFF:
      return runs::MachineState::kSwitchedOff;
    case v1::MACHINE_STATE_READY:
      return runs::MachineState::kReady;
    case v1::MACHINE_STATE_RUNNING:
      return runs::MachineState::kRunning;
    case v1::MACHINE_STATE_STOPPING:
      return runs::MachineState::kStopping;
    case v1::MACHINE_STATE_HELD:
      return runs::MachineState::kHeld;
    case v1::MACHINE_STATE_FAULT:
      return runs::MachineState::kFault;
    default:
      refuse("report.state", "is missing or none that this server knows");
  }
}

v1::MachineState encode_state(runs::MachineState state) {
  switch (state) {
    case runs::MachineState::kUnknown:
      return v1::MACHINE_STATE_UNSPECIFIED;
    case runs::MachineState::kSwitchedOff:
      return v1::MACHINE_STATE_SWITCHED_OFF;
    case runs::MachineState::kReady:
      return v1::MACHINE_STATE_READY;
    case runs::MachineState::kRunning:
      return v1::MACHINE_STATE_RUNNING;
    case runs::MachineState::kStopping:
      return v1::MACHINE_STATE_STOPPING;
    case runs::MachineState::kHeld:
      return v1::MACHINE_STATE_HELD;
    case runs::MachineState::kFault:
      return v1::MACHINE_STATE_FAULT;
  }
  return v1::MACHINE_STATE_UNSPECIFIED;
}

v1::RunState encode_state(runs::RunState state) {
  switch (state) {
    case runs::RunState::kWaiting:
      return v1::RUN_STATE_WAITING;
    case runs::RunState::kRunning:
      return v1::RUN_STATE_RUNNING;
    case runs::RunState::kStopping:
      return v1::RUN_STATE_STOPPING;
    case runs::RunState::kHeld:
      return v1::RUN_STATE_HELD;
    case runs::RunState::kFinished:
      return v1::RUN_STATE_FINISHED;
    case runs::RunState::kAborted:
      return v1::RUN_STATE_ABORTED;
    case runs::RunState::kFailed:
      return v1::RUN_STATE_FAILED;
  }
  return v1::RUN_STATE_UNSPECIFIED;
}

// Continues a CRC-32 with the numbers of these columns.
std::uint32_t encode_columns(const std::vector<motion::Vector>& positions, std::size_t axes,
                             RepeatedPtrField<v1::Column>& columns, std::uint32_t checksum) {
  static_assert(std::endian::native == std::endian::little);
  for (std::size_t axis = 0; axis < axes; ++axis) {
    auto& values = *columns.Add()->mutable_values();
    values.Reserve(static_cast<int>(positions.size()));
    for (const motion::Vector& position : positions)
      values.AddAlreadyReserved(position[static_cast<Eigen::Index>(axis)]);
    checksum = static_cast<std::uint32_t>(
        crc32_z(checksum, reinterpret_cast<const unsigned char*>(values.data()), positions.size() * sizeof(double)));
  }
  return checksum;
}

class OrderEncoder {
 public:
  OrderEncoder(std::size_t axes, v1::AttachMachineResponse& message) : axes_(axes), message_(message) {}

  void operator()(const runs::StartOrder& start) const {
    v1::Run& run = *message_.mutable_start();
    run.set_name(start.run);
    run.set_plan(start.plan);
    encode_position(start.position, axes_, *run.mutable_position_mm());
  }
  void operator()(const runs::StopOrder& stop) const {
    message_.set_command(stop.abort ? v1::MACHINE_COMMAND_ABORT : v1::MACHINE_COMMAND_HOLD);
  }
  void operator()(const runs::ResumeOrder& resume) const {
    message_.mutable_resume()->set_run(resume.run);
    message_.mutable_resume()->set_branch(resume.branch);
  }
  void operator()(const runs::BatchOrder& order) const {
    const runs::NumberedBatch& batch = order.batch;
    v1::MotionBatch& message = *message_.mutable_batch();
    message.set_run(order.run);
    message.set_branch(batch.branch);
    message.set_first_tick(batch.begin.tick);
    encode_clock(batch.begin.clock, *message.mutable_begin());
    const std::uint32_t checksum = encode_columns(batch.batch.positions, axes_, *message.mutable_position_mm(), 0);
    message.set_checksum(encode_columns(batch.batch.tail, axes_, *message.mutable_tail_mm(), checksum));
    encode_clock(batch.batch.end, *message.mutable_end());
    message.set_tail_end_s(batch.batch.tail_end);
    message.set_end_of_plan(batch.batch.end_of_plan);
    for (const runs::BatchMarker& due : batch.batch.markers) {
      v1::MarkerAt& marker = *message.add_markers();
      marker.set_tick(batch.begin.tick + due.setpoint);
      encode_marker(due.marker, *marker.mutable_marker());
    }
  }

 private:
  std::size_t axes_;
  v1::AttachMachineResponse& message_;
};

}  // namespace

void check_machine_name(const std::string& field, const std::string& name) {
  constexpr std::string_view kCollection = "machines/";
  constexpr std::size_t kMostBytes = 63;
  const bool is_name = name.starts_with(kCollection) && name.size() > kCollection.size() &&
                       name.size() <= kCollection.size() + kMostBytes &&
                       std::all_of(name.begin() + kCollection.size(), name.end(),
                                   [](unsigned char c) { return std::isalnum(c) != 0 || c == '-' || c == '_'; });
  if (!is_name) {
    refuse(field, "is no name of a machine: give \"machines/\" and 1 to 63 letters, digits, \"-\" or \"_\"");
  }
}

runs::MachineProfile decode_hello(const v1::MachineHello& hello) {
  check_machine_name("hello.machine", hello.machine());
  Violations violations;
  runs::MachineProfile profile{.name = hello.machine()};
  profile.limits = decode_limits(hello.limits(), "hello.limits", violations);
  const double period = hello.period_s();
  if (!violations.check_range("hello.period_s", period, 1e-4, 0.1, "s")) violations.refuse();
  const auto usual_batch = static_cast<std::uint32_t>(std::max(1.0, std::round(kUsualBatch / period)));
  const std::uint32_t batch = hello.batch_size() == 0 ? usual_batch : hello.batch_size();
  const double window = hello.window_s() == 0 ? kUsualWindow : hello.window_s();
  const double report = hello.report_s() == 0 ? kUsualReport : hello.report_s();
  violations.check_range("hello.batch_size", batch, 1, kMostSetpoints, "setpoints");
  violations.check_range("hello.window_s", window, 0.05, 10, "s");
  violations.check_range("hello.report_s", report, 0.001, 1, "s");
  if (hello.instance().size() > kMostInstance) violations.add("hello.instance", "is longer than 64 bytes");
  violations.check_range("hello.tail_capacity", hello.tail_capacity(), 1, kMostTail, "setpoints");
  violations.refuse();
  profile.feed = {
      .batch = {.period = period, .setpoints = batch, .tail_capacity = hello.tail_capacity()},
      .window = static_cast<std::uint64_t>(std::ceil(window / period)),
      .margin = static_cast<std::uint64_t>(std::ceil((report + kWay) / period)),
  };
  return profile;
}

runs::MachineReport decode_report(const v1::MachineReport& report, std::size_t axes) {
  runs::MachineReport decoded{.state = decode_state(report.state()),
                              .position = decode_position(report.position_mm(), axes),
                              .actual = decode_position(report.actual_mm(), axes),
                              .run = report.run().run(),
                              .fault = printable(report.fault(), kMostFault),
                              .starvations = report.counters().starvations(),
                              .refused_batches = report.counters().refused_batches(),
                              .run_finished = report.run_finished()};
  if (!decoded.run.empty()) decoded.where = decode_where(report.run());
  return decoded;
}

v1::AttachMachineResponse encode_order(const runs::Order& order, std::size_t axes) {
  v1::AttachMachineResponse message;
  std::visit(OrderEncoder(axes, message), order);
  return message;
}

v1::Run encode_run(const runs::Run& run, const Machines& machines) {
  constexpr double kPercent = 100;
  v1::Run message;
  message.set_name(run.name);
  message.set_plan(run.plan);
  message.set_state(encode_state(run.state));
  message.set_controller(run.controller);
  message.set_feed_override_percent(kPercent * run.rate);
  *message.mutable_create_time() = TimeUtil::MicrosecondsToTimestamp(run.create_time.time_since_epoch().count());
  message.set_cycle_time_s(run.cycle_time);
  message.set_plan_time_s(run.plan_time);
  const bool moves = run.state == runs::RunState::kRunning && run.rate > 0;
  if (moves) message.set_time_left_s((run.cycle_time - run.plan_time) / run.rate);
  message.set_feed_mm_s(run.feed);
  message.set_buffered_s(run.buffered);
  message.set_reason(run.reason);
  if (const auto machine = machines.try_find(run.name.substr(0, run.name.find("/runs/")))) {
    const runs::MachineReport report = machine->last_report();
    message.set_machine_state(encode_state(report.state));
    message.set_starvations(report.starvations);
    encode_position(run.position, machine->profile().limits.axes, *message.mutable_position_mm());
  }
  return message;
}

void encode_machine(const runs::Machine& machine, v1::AttachedMachine& message) {
  const runs::MachineProfile& profile = machine.profile();
  const runs::MachineReport report = machine.last_report();
  const std::size_t axes = profile.limits.axes;
  v1::MachineHello& hello = *message.mutable_hello();
  hello.set_machine(profile.name);
  hello.set_period_s(profile.feed.batch.period);
  hello.set_batch_size(static_cast<std::uint32_t>(profile.feed.batch.setpoints));
  hello.set_window_s(static_cast<double>(profile.feed.window) * profile.feed.batch.period);
  hello.set_tail_capacity(static_cast<std::uint32_t>(profile.feed.batch.tail_capacity));
  encode_limits(profile.limits, *hello.mutable_limits());
  message.mutable_report()->set_state(encode_state(report.state));
  encode_position(report.position, axes, *message.mutable_report()->mutable_position_mm());
  encode_position(report.actual, axes, *message.mutable_report()->mutable_actual_mm());
  message.mutable_report()->set_fault(report.fault);
  if (const auto run = machine.run(); run && !is_over(run->state)) message.set_run(run->name);
}

}  // namespace kcs::service
