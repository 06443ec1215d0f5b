#include "client/sdk/machine_messages.h"

#include <google/protobuf/util/time_util.h>

#include <chrono>

#include "client/sdk/messages.h"

namespace kcs::client {
namespace {

using google::protobuf::util::TimeUtil;

MachineState from_message(v1::MachineState state) {
  switch (state) {
    case v1::MACHINE_STATE_SWITCHED_OFF:
      return MachineState::kSwitchedOff;
    case v1::MACHINE_STATE_READY:
      return MachineState::kReady;
    case v1::MACHINE_STATE_RUNNING:
      return MachineState::kRunning;
    case v1::MACHINE_STATE_STOPPING:
      return MachineState::kStopping;
    case v1::MACHINE_STATE_HELD:
      return MachineState::kHeld;
    case v1::MACHINE_STATE_FAULT:
      return MachineState::kFault;
    default:
      return MachineState::kUnknown;
  }
}

RunState from_message(v1::RunState state) {
  switch (state) {
    case v1::RUN_STATE_RUNNING:
      return RunState::kRunning;
    case v1::RUN_STATE_STOPPING:
      return RunState::kStopping;
    case v1::RUN_STATE_HELD:
      return RunState::kHeld;
    case v1::RUN_STATE_FINISHED:
      return RunState::kFinished;
    case v1::RUN_STATE_ABORTED:
      return RunState::kAborted;
    case v1::RUN_STATE_FAILED:
      return RunState::kFailed;
    default:
      return RunState::kWaiting;
  }
}

}  // namespace

AttachedMachine from_message(const v1::AttachedMachine& message) {
  const v1::MachineReport& report = message.report();
  return {.name = message.hello().machine(),
          .limits = from_message(message.hello().limits()),
          .period_s = message.hello().period_s(),
          .window_s = message.hello().window_s(),
          .state = from_message(report.state()),
          .position_mm = {report.position_mm().begin(), report.position_mm().end()},
          .actual_mm = {report.actual_mm().begin(), report.actual_mm().end()},
          .fault = report.fault(),
          .run = message.run()};
}

Run from_message(const v1::Run& message) {
  return {.name = message.name(),
          .plan = message.plan(),
          .state = from_message(message.state()),
          .controller = message.controller(),
          .feed_override_percent = message.feed_override_percent(),
          .create_time = Time(std::chrono::microseconds(TimeUtil::TimestampToMicroseconds(message.create_time()))),
          .cycle_time_s = message.cycle_time_s(),
          .plan_time_s = message.plan_time_s(),
          .time_left_s = message.time_left_s(),
          .position_mm = {message.position_mm().begin(), message.position_mm().end()},
          .feed_mm_s = message.feed_mm_s(),
          .buffered_s = message.buffered_s(),
          .machine_state = from_message(message.machine_state()),
          .reason = message.reason()};
}

}  // namespace kcs::client
