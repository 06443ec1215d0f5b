#include "server/http/plan_call.h"

#include <chrono>
#include <stop_token>
#include <thread>
#include <utility>

#include "server/http/slow_spots.h"

namespace kcs::http {
namespace {

constexpr std::chrono::milliseconds kLook{20};  // how often it looks whether the call is still wanted
constexpr std::size_t kMessageBytes = 65536;    // what comes over HTTP comes in pieces of 4 KiB

}  // namespace

// Ends its call when nobody wants it any more.
class PlanCall::Context : public grpc::ClientContext {
 public:
  explicit Context(PlanCall& call)
      : call_(call), watch_([this](const std::stop_token& over) {
          while (!over.stop_requested() && call_.is_wanted_()) std::this_thread::sleep_for(kLook);
          if (!over.stop_requested()) TryCancel();
        }) {
    for (const auto& [key, value] : call.metadata_) AddMetadata(key, value);
  }

  // To be called once the call is over.
  void note_request_id() {
    const auto& metadata = GetServerTrailingMetadata();
    const auto id = metadata.find("x-request-id");
    if (id == metadata.end()) return;
    call_.request_id_.assign(id->second.data(), id->second.size());
    call_.metadata_["x-request-id"] = call_.request_id_;  // the calls that follow belong to it
  }

 private:
  PlanCall& call_;
  std::jthread watch_;  // last: gone before what it uses
};

std::optional<Answer> PlanCall::create(const v1::PlanOptions& options, const ReadProgram& read_program) {
  Context context(*this);
  v1::Plan plan;
  const auto writer = stub_->CreatePlan(&context, &plan);
  v1::CreatePlanRequest message;
  *message.mutable_options() = options;
  bool open = writer->Write(message);  // once it is not, the service has refused the request
  std::string& piece = *message.mutable_gcode();
  const bool complete = read_program([&](const char* bytes, std::size_t size) {
    piece.append(bytes, size);
    if (piece.size() < kMessageBytes) return open;
    open = open && writer->Write(message);
    piece.clear();
    return open;
  });
  if (open && !complete) {
    context.TryCancel();
  } else {
    if (open) writer->Write(message);
    writer->WritesDone();
  }
  const grpc::Status status = writer->Finish();
  context.note_request_id();
  if (open && !complete) return std::nullopt;
  return status.ok() ? describe(plan) : answer_of(status);
}

Answer PlanCall::get(const std::string& name) {
  Context context(*this);
  v1::GetPlanRequest request;
  request.set_name(name);
  v1::Plan plan;
  const grpc::Status status = stub_->GetPlan(&context, request, &plan);
  context.note_request_id();
  if (!status.ok()) return answer_of(status);
  if (plan.state() != v1::PLAN_STATE_READY) {
    return refusal(409, "FAILED_PRECONDITION", "the plan is not made yet: ask again later");
  }
  return describe(plan);
}

Answer PlanCall::describe(const v1::Plan& plan) {
  Context context(*this);
  v1::DescribeCornersRequest request;
  request.set_name(plan.name());
  const auto reader = stub_->DescribeCorners(&context, request);
  SlowSpots spots;
  for (v1::CornerBatch batch; reader->Read(&batch);) {
    for (const v1::Corner& corner : batch.corners()) spots.add(corner);
  }
  const grpc::Status status = reader->Finish();
  return status.ok() ? answer_of(plan, spots.finish()) : answer_of(status);
}

}  // namespace kcs::http
