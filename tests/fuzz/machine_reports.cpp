// Any bytes as what a gateway says of its machine: refused with a reason, or followed, and what it is sent then keeps
// the machine's limits.
#include <kcs/v1/machine.pb.h>

#include <cstdint>
#include <cstdlib>
#include <memory>
#include <string>

#include "server/planning/invalid_input.h"
#include "server/planning/plan_path.h"
#include "server/runs/machine.h"
#include "server/service/machine_messages.h"

namespace {

using namespace kcs;

void require(bool condition) {
  if (!condition) std::abort();
}

runs::MachineProfile profile() {
  runs::MachineProfile profile{.name = "machines/mill"};
  profile.limits.axes = 2;
  profile.limits.velocity = {100, 100, 0};
  profile.limits.acceleration = {1000, 1000, 0};
  profile.limits.jerk = {1e5, 1e5, 0};
  return profile;
}

jobs::PlanPointer make_plan() {
  auto kept = std::make_shared<jobs::KeptPlan>();
  kept->options.planning.limits = profile().limits;
  planning::Toolpath path;
  for (const double x : {5.0, 10.0, 15.0}) {
    path.segments.push_back(
        {.end = {x, 0, 0}, .feed = 100, .tolerance = 0.01, .marker = {.kind = planning::MarkerKind::kFloodOn}});
  }
  kept->plan = planning::plan(path, kept->options.planning);
  return kept;
}

// A run begins, and the machine says how it goes; it gets its orders as long as there are some.
void follow(const v1::MachineReport& message) {
  static const jobs::PlanPointer kPlan = make_plan();
  runs::Machine machine(profile());
  runs::MachineReport ready{.state = runs::MachineState::kReady};
  machine.attach(ready);
  machine.begin({.name = "machines/mill/runs/1", .plan = "plans/x"}, kPlan);
  machine.report(service::decode_report(message, 2));
  for (int i = 0; i < 20; ++i) {
    const auto order = machine.next_order({});
    if (!order) break;
    const v1::AttachMachineResponse sent = service::encode_order(*order, 2);
    require(sent.content_case() != v1::AttachMachineResponse::CONTENT_NOT_SET);
    require(sent.batch().markers_size() <= static_cast<int>(runs::kMostMarkers));
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  v1::AttachMachineRequest request;
  if (!request.ParseFromArray(data, static_cast<int>(size))) return 0;
  try {
    if (request.has_hello()) service::decode_hello(request.hello());
    if (request.has_report()) follow(request.report());
  } catch (const planning::InvalidInput& refused) {
    require(!refused.violations().empty());
  }
  return 0;
}
