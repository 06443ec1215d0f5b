// Any bytes as the messages of a CreatePlan call: refused with a reason, or planned, verified and sampled; PlanLive
// gives the same, and so does the request once it was stored.
#include <google/protobuf/io/zero_copy_stream_impl_lite.h>
#include <google/protobuf/util/delimited_message_util.h>
#include <kcs/v1/planning.pb.h>

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <exception>
#include <string>
#include <vector>

#include "server/jobs/cap_exceeded.h"
#include "server/motion/sampler.h"
#include "server/planning/invalid_input.h"
#include "server/planning/plan_path.h"
#include "server/service/live_call.h"
#include "server/service/request_code.h"
#include "server/service/upload.h"

namespace {

// Small, so that a run takes milliseconds.
const kcs::service::Caps kCaps{.points_per_plan = 300, .gcode_bytes = 1 << 16, .message_bytes = 1 << 16};

void require(bool condition) {
  if (!condition) std::abort();
}

// Plans the messages live, and compares the setpoints with those of the stored plan.
void compare_live(const std::vector<kcs::v1::CreatePlanRequest>& messages, double period,
                  kcs::motion::Sampler& sampler) {
  std::uint64_t next = 0;
  bool planned = false;
  kcs::service::LiveCall call(kCaps, [&](const kcs::v1::PlanLiveResponse& response) {
    planned = response.has_plan();
    const kcs::v1::SetpointBatch& batch = response.setpoints();
    for (int i = 0; !planned && i < batch.position_mm(0).values_size(); ++i) {
      require(batch.position_mm(0).values(i) == sampler.at(next++).state.position.x());
    }
  });
  for (const kcs::v1::CreatePlanRequest& message : messages) {
    kcs::v1::PlanLiveRequest piece;
    require(piece.ParseFromString(message.SerializeAsString()));
    if (piece.has_options()) piece.mutable_output()->set_period_s(period);
    call.add(piece);
  }
  call.finish();
  require(planned && next == sampler.count());
}

// The names are digests of all that a request says.
void compare_stored(const kcs::service::Uploaded& uploaded) {
  const std::string bytes = kcs::service::encode_request(uploaded.request, uploaded.gcode);
  try {
    require(kcs::service::decode_request(uploaded.request.name, bytes, kCaps).name == uploaded.request.name);
  } catch (const std::exception&) {
    require(false);
  }
}

void plan_and_sample(const kcs::jobs::PlanRequest& request, const std::vector<kcs::v1::CreatePlanRequest>& messages) {
  // A plan that fails its verification throws, and nobody catches it here.
  const kcs::planning::Plan plan = kcs::planning::plan(request.path, request.options.planning);
  const double period = std::clamp(plan.trajectory.duration() / 50, 1e-5, 10.0);
  kcs::motion::Sampler sampler(plan.trajectory, period);
  if (sampler.count() > 10'000) return;  // days
  for (std::uint64_t i = 0; i < sampler.count(); ++i) require(sampler.at(i).state.position.allFinite());
  compare_live(messages, period, sampler);
}

}  // namespace

// The input is a sequence of CreatePlanRequest messages, each after its length as a varint.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  google::protobuf::io::ArrayInputStream input(data, static_cast<int>(size));
  kcs::service::Upload upload(kCaps);
  try {
    std::vector<kcs::v1::CreatePlanRequest> messages(1);
    bool at_end = false;
    while (google::protobuf::util::ParseDelimitedFromZeroCopyStream(&messages.back(), &input, &at_end)) {
      upload.add(messages.back());
      messages.emplace_back();
    }
    messages.pop_back();
    const kcs::service::Uploaded uploaded = upload.finish();
    compare_stored(uploaded);
    plan_and_sample(uploaded.request, messages);
  } catch (const kcs::planning::InvalidInput&) {
  } catch (const kcs::jobs::CapExceeded&) {
  }
  return 0;
}
