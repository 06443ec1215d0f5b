// One execution of a plan on a machine.
#pragma once

#include <chrono>
#include <string>

#include "server/motion/phase.h"

namespace kcs::runs {

enum class RunState {
  kWaiting,  // for the machine to take it up
  kRunning,
  kStopping,  // comes to rest
  kHeld,      // at rest on the path
  kFinished,  // over: the end of the path was reached,
  kAborted,   // somebody ended it,
  kFailed,    // the machine failed
};

inline bool is_over(RunState state) { return state >= RunState::kFinished; }

struct Run {
  std::string name;  // "machines/NAME/runs/NUMBER"
  std::string plan;
  std::string controller;  // who may resume it and set its pace
  RunState state = RunState::kWaiting;
  double rate = 1;  // the feed override; 1: as planned
  std::chrono::sys_time<std::chrono::microseconds> create_time{};
  double cycle_time = 0;                             // of the plan, s
  double plan_time = 0;                              // where in the plan the machine is, about, s
  motion::Vector position = motion::Vector::Zero();  // commanded, mm
  double feed = 0;                                   // along the path, mm/s
  double buffered = 0;                               // motion that the machine holds, s
  std::string reason;                                // why it stopped, if nobody asked it to
  bool hold_asked = false;                           // it is to come to rest, or rests, until it is resumed
  bool abort_asked = false;

  bool operator==(const Run&) const = default;
};

}  // namespace kcs::runs
