// What clients do with plans that are there.
#include <functional>
#include <optional>
#include <thread>

#include "tests/soak/client.h"

namespace kcs::soak {
namespace {

using Code = grpc::StatusCode;

v1::StreamSetpointsRequest setpoints(const std::string& plan) {
  v1::StreamSetpointsRequest request;
  request.set_name(plan);
  request.set_period_s(0.001);
  request.add_channels(v1::CHANNEL_VELOCITY);
  return request;
}

}  // namespace

StreamEnd read_setpoints(v1::PlanningService::Stub& stub, Call& call, const std::string& plan) {
  const auto reader = stub.StreamSetpoints(&call, setpoints(plan));
  StreamEnd end;
  v1::SetpointBatch batch;
  while (reader->Read(&batch)) end.digest = 31 * end.digest + std::hash<std::string>()(batch.SerializeAsString());
  end.status = reader->Finish();
  return end;
}

void Client::get() {
  const std::optional<Entry> known = ledger_.any(random_);
  if (!known) return;
  v1::GetPlanRequest request;
  request.set_name(known->name);
  Call call;
  v1::Plan plan;
  if (count("GetPlan", call, stub_->GetPlan(&call, request, &plan), known->name)) compare(plan);
}

void Client::watch() {
  const std::optional<Entry> known = ledger_.any(random_);
  if (!known) return;
  v1::WatchPlanRequest request;
  request.set_name(known->name);
  Call call;
  const auto reader = stub_->WatchPlan(&call, request);
  v1::PlanProgress progress;
  while (reader->Read(&progress)) continue;
  if (count("WatchPlan", call, reader->Finish(), known->name) && progress.state() != v1::PLAN_STATE_READY) {
    tally_.fault("WatchPlan ended before " + known->name + " was READY");
  }
}

void Client::list() {
  v1::ListPlansRequest request;
  request.set_page_size(whole(1, 1000));
  if (whole(0, 1) == 0) request.mutable_filter()->set_machine_name(machine_name(whole(0, kMachines - 1)));
  if (whole(0, 3) == 0) request.mutable_filter()->set_state(v1::PLAN_STATE_READY);
  if (whole(0, 3) == 0) request.mutable_filter()->set_cycle_time_at_least_s(whole(0, 10));
  for (int page = 0; page < 3; ++page) {
    Call call;
    v1::ListPlansResponse response;
    if (!tally_.count("ListPlans", call.began, stub_->ListPlans(&call, request, &response), {})) return;
    if (response.next_page_token().empty()) return;
    request.set_page_token(response.next_page_token());
  }
}

void Client::stream() {
  const std::optional<Entry> known = ledger_.any(random_);
  if (!known) return;
  Call call;
  const StreamEnd end = read_setpoints(*stub_, call, known->name);
  if (!count("StreamSetpoints", call, end.status, known->name, {Code::RESOURCE_EXHAUSTED})) return;
  if (!ledger_.agrees(known->name, end.digest)) tally_.fault(known->name + " streams other bytes than before");
}

void Client::stream_and_give_up() {
  const std::optional<Entry> known = ledger_.any(random_);
  if (!known) return;
  v1::StreamSetpointsRequest request = setpoints(known->name);
  request.set_batch_size(static_cast<std::uint32_t>(whole(1, 100)));
  Call call;
  const auto reader = stub_->StreamSetpoints(&call, request);
  v1::SetpointBatch batch;
  for (int left = whole(0, 20); left > 0 && reader->Read(&batch); --left) continue;
  call.TryCancel();
  count("StreamSetpoints", call, reader->Finish(), known->name, {Code::CANCELLED, Code::RESOURCE_EXHAUSTED});
}

void Client::stream_at_pace(const std::stop_token& stop) {
  const std::optional<Entry> known = ledger_.any(random_);
  if (!known) return;
  v1::StreamSetpointsRequest request = setpoints(known->name);
  request.set_lead_s(0.05);
  Call call;
  const auto reader = stub_->StreamSetpoints(&call, request);
  const auto end = Clock::now() + std::chrono::milliseconds(whole(100, 5000));
  v1::SetpointBatch batch;
  while (reader->Read(&batch)) {
    if (Clock::now() > end || stop.stop_requested()) call.TryCancel();
  }
  count("StreamSetpoints", call, reader->Finish(), known->name, {Code::CANCELLED, Code::RESOURCE_EXHAUSTED});
}

// Takes a batch of much more than goes at once, and looks away.
void Client::stream_slowly(const std::stop_token& stop) {
  const std::optional<Entry> known = ledger_.any(random_);
  if (!known) return;
  v1::StreamSetpointsRequest request = setpoints(known->name);
  request.set_period_s(1e-5);
  request.set_batch_size(static_cast<std::uint32_t>(whole(1, 32'768)));
  Call call;
  const auto reader = stub_->StreamSetpoints(&call, request);
  const auto end = Clock::now() + std::chrono::milliseconds(whole(100, 5000));
  v1::SetpointBatch batch;
  while (reader->Read(&batch)) {
    if (Clock::now() > end || stop.stop_requested()) call.TryCancel();
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
  }
  count("StreamSetpoints", call, reader->Finish(), known->name, {Code::CANCELLED, Code::RESOURCE_EXHAUSTED});
}

void Client::describe_corners() {
  const std::optional<Entry> known = ledger_.any(random_);
  if (!known) return;
  v1::DescribeCornersRequest request;
  request.set_name(known->name);
  Call call;
  const auto reader = stub_->DescribeCorners(&call, request);
  v1::CornerBatch batch;
  while (reader->Read(&batch)) continue;
  count("DescribeCorners", call, reader->Finish(), known->name, {Code::RESOURCE_EXHAUSTED});
}

// The path of a plan that is kept: the same plan comes out.
void Client::plan_live() {
  const std::optional<Entry> known = ledger_.any(random_);
  if (!known || known->recipe.size == Size::kLarge) return;  // it would have to be read while it is sent
  Call call;
  const auto stream = stub_->PlanLive(&call);
  for (const v1::PlanLiveRequest& message : live_messages(known->recipe, 0.01)) {
    if (!stream->Write(message)) break;
  }
  stream->WritesDone();
  v1::PlanLiveResponse response;
  while (stream->Read(&response)) continue;
  if (!tally_.count("PlanLive", call.began, stream->Finish(), {Code::RESOURCE_EXHAUSTED})) return;
  if (response.plan().name() != known->name) tally_.fault(known->name + " has another name when planned live");
}

}  // namespace kcs::soak
