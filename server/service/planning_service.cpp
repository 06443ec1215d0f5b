#include "server/service/planning_service.h"

#include <grpcpp/support/method_handler.h>

#include <algorithm>
#include <chrono>
#include <future>
#include <memory>
#include <utility>

#include "server/service/encode.h"
#include "server/service/setpoint_stream.h"
#include "server/service/status.h"
#include "server/service/upload.h"
#include "server/service/violations.h"

namespace kcs::service {
namespace {

constexpr std::size_t kCornersPerBatch = 1000;
// How soon a client that gave up is noticed while its plan is made.
constexpr std::chrono::milliseconds kCancellationCheck{50};

v1::CreatePlanRequest parse(grpc::ByteBuffer& bytes) {
  v1::CreatePlanRequest message;
  if (!grpc::SerializationTraits<v1::CreatePlanRequest>::Deserialize(&bytes, &message).ok()) {
    refuse("content", "the message is not a CreatePlanRequest of kcs.v1");
  }
  return message;
}

// Counts a call for as long as it runs.
class Running {
 public:
  explicit Running(std::atomic<int>& count) : count_(count) { ++count_; }
  ~Running() { --count_; }
  Running(const Running&) = delete;
  Running& operator=(const Running&) = delete;

 private:
  std::atomic<int>& count_;
};

void require_name(const std::string& name) {
  if (name.empty()) refuse("name", "is missing: give the name of a plan");
}

}  // namespace

PlanningService::PlanningService(jobs::PlanDesk& desk, const Caps& caps)
    : desk_(desk), caps_(caps), uploads_("uploads", caps.uploads), streams_("streams", caps.streams) {
  const auto* method =
      v1::Plan::descriptor()->file()->FindServiceByName("PlanningService")->FindMethodByName("CreatePlan");
  using Handler = grpc::internal::ClientStreamingHandler<PlanningService, grpc::ByteBuffer, v1::Plan>;
  const auto handle = [](PlanningService* self, grpc::ServerContext* context, UploadReader* reader, v1::Plan* plan) {
    return self->create_plan(context, reader, plan);
  };
  MarkMethodStreamed(method->index(), std::make_unique<Handler>(handle, this).release());
}

template <typename Work>
grpc::Status PlanningService::answer(std::string_view method, const Work& work) {
  const Running running(running_);
  try {
    if (closed_) throw Stopping();
    return work();
  } catch (...) {
    return status_of_current_exception(method);
  }
}

grpc::Status PlanningService::create_plan(grpc::ServerContext* context, UploadReader* reader, v1::Plan* plan) {
  return answer("CreatePlan", [&]() -> grpc::Status {
    const Gate::Pass pass(uploads_);
    Upload upload(caps_);
    grpc::ByteBuffer bytes;
    while (reader->Read(&bytes)) upload.add(parse(bytes));
    if (context->IsCancelled()) return grpc::Status::CANCELLED;
    const std::shared_future<jobs::PlanPointer> planned = desk_.submit(upload.finish());
    while (planned.wait_for(kCancellationCheck) != std::future_status::ready) {
      if (context->IsCancelled()) return grpc::Status::CANCELLED;
    }
    encode_plan(*planned.get(), *plan);
    return grpc::Status::OK;
  });
}

grpc::Status PlanningService::GetPlan(grpc::ServerContext* /*context*/, const v1::GetPlanRequest* request,
                                      v1::Plan* plan) {
  return answer("GetPlan", [&] {
    encode_plan(*find(request->name()), *plan);
    return grpc::Status::OK;
  });
}

grpc::Status PlanningService::DeletePlan(grpc::ServerContext* /*context*/, const v1::DeletePlanRequest* request,
                                         google::protobuf::Empty* /*nothing*/) {
  return answer("DeletePlan", [&] {
    require_name(request->name());
    if (!desk_.store().forget(request->name())) throw NotKept();
    return grpc::Status::OK;
  });
}

grpc::Status PlanningService::StreamSetpoints(grpc::ServerContext* /*context*/,
                                              const v1::StreamSetpointsRequest* request,
                                              grpc::ServerWriter<v1::SetpointBatch>* writer) {
  return answer("StreamSetpoints", [&] {
    const Gate::Pass pass(streams_);
    SetpointStream stream(find(request->name()), *request);
    v1::SetpointBatch batch;
    while (stream.next(batch)) {
      if (!writer->Write(batch)) return grpc::Status::CANCELLED;
    }
    return grpc::Status::OK;
  });
}

grpc::Status PlanningService::DescribeCorners(grpc::ServerContext* /*context*/,
                                              const v1::DescribeCornersRequest* request,
                                              grpc::ServerWriter<v1::CornerBatch>* writer) {
  return answer("DescribeCorners", [&] {
    const Gate::Pass pass(streams_);
    const jobs::PlanPointer kept = find(request->name());
    const planning::CornerList& corners = kept->plan.corners;
    for (std::size_t first = 0; first < corners.size(); first += kCornersPerBatch) {
      v1::CornerBatch batch;
      const std::size_t end = std::min(first + kCornersPerBatch, corners.size());
      for (std::size_t i = first; i < end; ++i) encode_corner(corners[i], kept->options.planning, *batch.add_corners());
      if (!writer->Write(batch)) return grpc::Status::CANCELLED;
    }
    return grpc::Status::OK;
  });
}

jobs::PlanPointer PlanningService::find(const std::string& name) {
  require_name(name);
  jobs::PlanPointer kept = desk_.store().find(name);
  if (!kept) throw NotKept();
  return kept;
}

}  // namespace kcs::service
