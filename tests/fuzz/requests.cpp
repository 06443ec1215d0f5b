// Any bytes as the requests beside CreatePlan, and as what a damaged store gives back: refused with a reason, or served
// as asked.
#include <kcs/v1/planning.pb.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdlib>
#include <exception>
#include <memory>
#include <string>

#include "server/jobs/cap_exceeded.h"
#include "server/planning/invalid_input.h"
#include "server/planning/plan_path.h"
#include "server/service/live_call.h"
#include "server/service/pace.h"
#include "server/service/plan_records.h"
#include "server/service/request_code.h"
#include "server/service/setpoint_stream.h"
#include "server/service/status.h"
#include "server/store/errors.h"
#include "server/store/page_token.h"

namespace {

using namespace kcs;

// Small, so that a run takes milliseconds.
const service::Caps kCaps{.points_per_plan = 300, .gcode_bytes = 1 << 16, .message_bytes = 1 << 16};

void require(bool condition) {
  if (!condition) std::abort();
}

// Half a second of motion.
jobs::PlanPointer make_plan() {
  jobs::KeptPlan kept;
  planning::PlanOptions& options = kept.options.planning;
  options.limits.axes = 2;
  options.limits.velocity = {100, 100, 0};
  options.limits.acceleration = {1000, 1000, 0};
  options.limits.jerk = {1e5, 1e5, 0};
  planning::Toolpath path;
  for (const auto& [x, y] : {std::array{10.0, 0.0}, std::array{10.0, 10.0}, std::array{0.0, 0.0}}) {
    path.segments.push_back({.end = {x, y, 0}, .feed = 100, .tolerance = 0.01});
  }
  kept.plan = planning::plan(path, options);
  return std::make_shared<const jobs::KeptPlan>(std::move(kept));
}

void stream_setpoints(const std::string& bytes) {
  static const jobs::PlanPointer kPlan = make_plan();
  v1::StreamSetpointsRequest request;
  if (!request.ParseFromString(bytes)) return;
  service::SetpointStream stream(kPlan, request);
  const service::Pace pace(request, {}, [] { return true; });
  v1::SetpointBatch batch;
  std::uint64_t next = request.first_index();
  for (int i = 0; i < 3 && stream.next(batch); ++i) {
    require(batch.first_index() == next && batch.position_mm_size() == 2);
    require(!request.has_last_index() || batch.first_index() <= request.last_index());
    next += static_cast<std::uint64_t>(batch.position_mm(0).values_size());
  }
  require(next > request.first_index());
}

void list_plans(const std::string& bytes) {
  v1::ListPlansRequest request;
  if (!request.ParseFromString(bytes)) return;
  const store::Filter filter = service::decode_filter(request.filter());
  const store::Whose whose = "somebody";
  const store::PageEnd end{.create_time = store::Time(std::chrono::microseconds(request.page_size())),
                           .name = "plans/x"};
  const store::PageEnd again = store::parse_page_token(store::page_token(end, whose, filter), whose, filter);
  require(again.create_time == end.create_time && again.name == end.name);
  store::parse_page_token(request.page_token(), whose, filter);
}

// The beginning of a call: its options, and what is to be sent back.
void plan_live(const std::string& bytes) {
  v1::PlanLiveRequest request;
  if (!request.ParseFromString(bytes)) return;
  service::LiveCall call(kCaps, [](const v1::PlanLiveResponse&) {});
  call.add(request);
}

void stored_request(const std::string& bytes) {
  const std::string name = "plans/" + std::string(64, '0');
  require(service::decode_request(name, bytes, kCaps).name == name);
}

void stored_outcome(const std::string& bytes) {
  service::encode_record({.name = "plans/x", .state = store::State::kFinished, .outcome = bytes},
                         v1::PLAN_STATE_WAITING);
}

void stored_refusal(const std::string& bytes) { service::decode_refusal(bytes); }

}  // namespace

// The first byte says what the others are.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  constexpr std::array kReaders = {stream_setpoints, list_plans,     plan_live,
                                   stored_request,   stored_outcome, stored_refusal};
  if (size == 0) return 0;
  const std::string bytes(reinterpret_cast<const char*>(data + 1), size - 1);
  try {
    kReaders[data[0] % kReaders.size()](bytes);
  } catch (const planning::InvalidInput& refused) {
    require(!refused.violations().empty());
  } catch (const jobs::CapExceeded&) {
  } catch (const store::InvalidPageToken&) {
  } catch (const std::runtime_error& damaged) {
    require(data[0] % kReaders.size() > 2 && std::string(damaged.what()).find("damaged") != std::string::npos);
  }
  return 0;
}
