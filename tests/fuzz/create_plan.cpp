// Any bytes as the messages of a CreatePlan call: refused with a reason, or planned, verified and sampled.
#include <google/protobuf/io/zero_copy_stream_impl_lite.h>
#include <google/protobuf/util/delimited_message_util.h>
#include <kcs/v1/planning.pb.h>

#include <cstdint>
#include <cstdlib>

#include "server/jobs/cap_exceeded.h"
#include "server/motion/sampler.h"
#include "server/planning/invalid_input.h"
#include "server/planning/planner.h"
#include "server/service/upload.h"

namespace {

// Small, so that a run takes milliseconds.
const kcs::service::Caps kCaps{.points_per_plan = 300, .gcode_bytes = 1 << 16, .message_bytes = 1 << 16};

void plan_and_sample(const kcs::jobs::PlanRequest& request) {
  // A plan that fails its verification throws, and nobody catches it here.
  const kcs::planning::Plan plan = kcs::planning::plan(request.path, request.options.planning);
  const double duration = plan.trajectory.duration();
  kcs::motion::Sampler sampler(plan.trajectory, duration > 0 ? duration / 50 : 1);
  for (std::uint64_t i = 0; i < sampler.count(); ++i) {
    if (!sampler.at(i).state.position.allFinite()) std::abort();
  }
}

}  // namespace

// The input is a sequence of CreatePlanRequest messages, each after its length as a varint.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  google::protobuf::io::ArrayInputStream input(data, static_cast<int>(size));
  kcs::service::Upload upload(kCaps);
  try {
    kcs::v1::CreatePlanRequest message;
    bool at_end = false;
    while (google::protobuf::util::ParseDelimitedFromZeroCopyStream(&message, &input, &at_end)) {
      upload.add(message);
      message.Clear();
    }
    plan_and_sample(upload.finish());
  } catch (const kcs::planning::InvalidInput&) {
  } catch (const kcs::jobs::CapExceeded&) {
  }
  return 0;
}
