// A run of a plan on a machine, as it is kept.
#pragma once

#include <string>

#include "server/store/records.h"

namespace kcs::store {

enum class RunRecordState {
  kOpen,      // not over: the machine may still move by it
  kFinished,  // the end of the path was reached
  kAborted,
  kFailed,
};

// What another server has to know to go on with the run. Numbers are finite.
struct RunRecord {
  std::string name;        // "machines/NAME/runs/NUMBER", numbers from 1
  std::string machine;     // "machines/NAME"
  std::string plan;        // Record::name
  std::string controller;  // who may resume it and set its pace
  RunRecordState state = RunRecordState::kOpen;
  bool held = false;         // at rest until it is resumed
  double feed_override = 1;  // ≥ 0; 1: as planned
  double plan_time = 0;      // s; where in the plan the machine was when this was written down
  std::string reason;        // why it stopped, if it was not asked to
  Time create_time{};

  bool operator==(const RunRecord&) const = default;
};

}  // namespace kcs::store
