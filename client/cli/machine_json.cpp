#include "client/cli/machine_json.h"

#include <nlohmann/json.hpp>

#include "client/common/names.h"

namespace kcs::cli {
namespace {

using Json = nlohmann::ordered_json;

}  // namespace

std::string run_json(const client::Run& run) {
  const Json json = {{"name", run.name},
                     {"plan", run.plan},
                     {"state", name_of(run.state)},
                     {"machine_state", name_of(run.machine_state)},
                     {"controller", run.controller},
                     {"feed_override_percent", run.feed_override_percent},
                     {"cycle_time_s", run.cycle_time_s},
                     {"plan_time_s", run.plan_time_s},
                     {"time_left_s", run.time_left_s},
                     {"position_mm", run.position_mm},
                     {"feed_mm_s", run.feed_mm_s},
                     {"buffered_s", run.buffered_s},
                     {"reason", run.reason}};
  return json.dump() + "\n";
}

std::string machines_json(const std::vector<client::AttachedMachine>& machines) {
  std::string text;
  for (const client::AttachedMachine& machine : machines) {
    const Json json = {{"name", machine.name},
                       {"state", name_of(machine.state)},
                       {"run", machine.run},
                       {"position_mm", machine.position_mm},
                       {"actual_mm", machine.actual_mm},
                       {"fault", machine.fault},
                       {"axes", machine.limits.axes},
                       {"velocity_mm_s", machine.limits.velocity_mm_s},
                       {"acceleration_mm_s2", machine.limits.acceleration_mm_s2},
                       {"jerk_mm_s3", machine.limits.jerk_mm_s3},
                       {"period_s", machine.period_s},
                       {"window_s", machine.window_s}};
    text += json.dump() + "\n";
  }
  return text;
}

}  // namespace kcs::cli
