#include "server/service/planning_service.h"

#include <grpcpp/support/method_handler.h>

#include <algorithm>
#include <functional>
#include <memory>
#include <utility>

#include "server/service/encode.h"
#include "server/service/live_call.h"
#include "server/service/pace.h"
#include "server/service/setpoint_stream.h"
#include "server/service/upload.h"
#include "server/service/violations.h"

namespace kcs::service {

namespace {

template <typename Request>
Request parse(grpc::ByteBuffer& bytes) {
  Request message;
  if (!grpc::SerializationTraits<Request>::Deserialize(&bytes, &message).ok()) {
    refuse("content", "the message is not a " + Request::descriptor()->name() + " of kcs.v1");
  }
  return message;
}

}  // namespace

PlanningService::PlanningService(Plans& plans, const Caps& caps, Calls& calls)
    : plans_(plans),
      caps_(caps),
      calls_(calls),
      uploads_({"uploads", caps.uploads}, {"client_uploads", caps.client_uploads}),
      streams_({"streams", caps.streams}, {"client_streams", caps.client_streams}),
      live_streams_({"live_streams", caps.live_streams}, {"client_live_streams", caps.client_live_streams}) {
  using Create = grpc::internal::ClientStreamingHandler<PlanningService, grpc::ByteBuffer, v1::Plan>;
  using Live = grpc::internal::BidiStreamingHandler<PlanningService, grpc::ByteBuffer, v1::PlanLiveResponse>;
  handle("CreatePlan", std::make_unique<Create>(std::mem_fn(&PlanningService::create_plan), this));
  handle("PlanLive", std::make_unique<Live>(std::mem_fn(&PlanningService::plan_live), this));
}

void PlanningService::handle(const char* method, std::unique_ptr<grpc::internal::MethodHandler> handler) {
  const auto* service = v1::Plan::descriptor()->file()->FindServiceByName("PlanningService");
  MarkMethodStreamed(service->FindMethodByName(method)->index(), handler.release());
}

grpc::Status PlanningService::create_plan(grpc::ServerContext* context, UploadReader* reader, v1::Plan* plan) {
  return calls_.answer("CreatePlan", *context, [&](CallRecord& call, const Caller& caller) -> grpc::Status {
    const Gate::Pass pass(uploads_, caller.client);
    Upload upload(caps_);
    grpc::ByteBuffer bytes;
    while (reader->Read(&bytes)) upload.add(parse<v1::CreatePlanRequest>(bytes));
    caller.require_wanted();
    Uploaded uploaded = upload.finish();
    uploaded.request.call = caller.request_id;
    call.note("plan", uploaded.request.name);
    *plan = plans_.create(caller, std::move(uploaded));
    return grpc::Status::OK;
  });
}

grpc::Status PlanningService::plan_live(grpc::ServerContext* context, LiveStream* stream) {
  return calls_.answer("PlanLive", *context, [&](CallRecord& call, const Caller& caller) -> grpc::Status {
    const Gate::Pass pass(live_streams_, caller.client);
    const CancelWatch::Call watched(cancel_watch_, *context);
    const auto send = [&](const v1::PlanLiveResponse& response) {
      if (!stream->Write(response)) throw Cancelled();
      count_setpoints(response.setpoints());
      if (response.has_plan()) call.note("plan", response.plan().name());
    };
    LiveCall live(caps_, send, watched.stop());
    grpc::ByteBuffer bytes;
    while (stream->Read(&bytes)) {
      calls_.observation().metrics.segments_planned.add(live.add(parse<v1::PlanLiveRequest>(bytes)));
    }
    if (context->IsCancelled()) throw Cancelled();
    calls_.observation().metrics.segments_planned.add(live.finish());
    return grpc::Status::OK;
  });
}

grpc::Status PlanningService::GetPlan(grpc::ServerContext* context, const v1::GetPlanRequest* request, v1::Plan* plan) {
  return calls_.answer("GetPlan", *context, [&](CallRecord& call, const Caller& caller) {
    call.note("plan", request->name());
    *plan = plans_.get(caller, request->name());
    return grpc::Status::OK;
  });
}

grpc::Status PlanningService::ListPlans(grpc::ServerContext* context, const v1::ListPlansRequest* request,
                                        v1::ListPlansResponse* response) {
  return calls_.answer("ListPlans", *context, [&](CallRecord& /*call*/, const Caller& caller) {
    *response = plans_.list(caller, *request);
    return grpc::Status::OK;
  });
}

grpc::Status PlanningService::WatchPlan(grpc::ServerContext* context, const v1::WatchPlanRequest* request,
                                        grpc::ServerWriter<v1::PlanProgress>* writer) {
  return calls_.answer("WatchPlan", *context, [&](CallRecord& call, const Caller& caller) {
    call.note("plan", request->name());
    const Gate::Pass pass(streams_, caller.client);
    plans_.watch(caller, request->name(), [writer](const v1::PlanProgress& progress) {
      if (!writer->Write(progress)) throw Cancelled();
    });
    return grpc::Status::OK;
  });
}

grpc::Status PlanningService::DeletePlan(grpc::ServerContext* context, const v1::DeletePlanRequest* request,
                                         google::protobuf::Empty* /*nothing*/) {
  return calls_.answer("DeletePlan", *context, [&](CallRecord& call, const Caller& caller) {
    call.note("plan", request->name());
    plans_.remove(caller, request->name());
    return grpc::Status::OK;
  });
}

grpc::Status PlanningService::StreamSetpoints(grpc::ServerContext* context, const v1::StreamSetpointsRequest* request,
                                              grpc::ServerWriter<v1::SetpointBatch>* writer) {
  return calls_.answer("StreamSetpoints", *context, [&](CallRecord& call, const Caller& caller) {
    call.note("plan", request->name());
    const Gate::Pass pass(streams_, caller.client);
    SetpointStream stream(plans_.load(caller, request->name()), *request);
    Pace pace(*request, calls_.ending(), [context] { return context->IsCancelled(); });
    v1::SetpointBatch batch;
    while (stream.next(batch)) {
      pace.wait_for(batch.first_index());
      if (!writer->Write(batch)) return grpc::Status::CANCELLED;
      count_setpoints(batch);
    }
    return grpc::Status::OK;
  });
}

grpc::Status PlanningService::DescribeCorners(grpc::ServerContext* context, const v1::DescribeCornersRequest* request,
                                              grpc::ServerWriter<v1::CornerBatch>* writer) {
  return calls_.answer("DescribeCorners", *context, [&](CallRecord& call, const Caller& caller) {
    call.note("plan", request->name());
    const Gate::Pass pass(streams_, caller.client);
    const jobs::PlanPointer kept = plans_.load(caller, request->name());
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

void PlanningService::count_setpoints(const v1::SetpointBatch& batch) const {
  if (batch.position_mm().empty()) return;
  calls_.observation().metrics.setpoints_sent.add(static_cast<std::uint64_t>(batch.position_mm(0).values_size()));
}

}  // namespace kcs::service
