// Machines that are attached to a server, and the runs of plans on them. proto/kcs/v1/machine.proto says every field in
// full.
#pragma once

#include <string>
#include <vector>

#include "client/sdk/machine.h"
#include "client/sdk/plan.h"

namespace kcs::client {

// What a machine does.
enum class MachineState {
  kUnknown,      // its gateway is not attached
  kSwitchedOff,  // drives are off
  kReady,        // drives are on; at rest, without a run or before its first setpoint
  kRunning,
  kStopping,
  kHeld,   // at rest on the path of a run that is not over
  kFault,  // latched until the operator resets it at the machine
};

// Positions have one number per axis.
struct AttachedMachine {
  std::string name;  // "machines/NAME"
  Machine limits;    // a plan's must be inside of them
  double period_s = 0;
  double window_s = 0;  // of motion that is sent ahead of what is played
  MachineState state = MachineState::kUnknown;
  std::vector<double> position_mm;  // commanded
  std::vector<double> actual_mm;
  std::string fault;  // why it stands or stops; empty: nothing is wrong
  std::string run;    // that is not over; empty: none
};

enum class RunState {
  kWaiting,   // for the machine to take it up, or to be attached again
  kRunning,   // at rest too, if the override is 0 %
  kStopping,  // comes to rest
  kHeld,      // at rest on the path; can be resumed
  kFinished,  // over: the end of the path was reached,
  kAborted,   // somebody ended it,
  kFailed,    // the machine failed
};

inline bool is_over(RunState state) { return state >= RunState::kFinished; }

struct Run {
  std::string name;  // "machines/NAME/runs/NUMBER"
  std::string plan;  // "plans/…"
  RunState state = RunState::kWaiting;
  std::string controller;  // who may resume it and set its pace
  double feed_override_percent = 100;
  Time create_time{};
  double cycle_time_s = 0;          // of the plan
  double plan_time_s = 0;           // where in the plan the machine is
  double time_left_s = 0;           // at this pace; 0 at rest
  std::vector<double> position_mm;  // commanded; empty: the machine is not attached
  double feed_mm_s = 0;             // along the path
  double buffered_s = 0;            // motion that the machine holds beyond what it has played
  MachineState machine_state = MachineState::kUnknown;
  std::string reason;  // why it stopped, if it was not asked to
};

}  // namespace kcs::client
