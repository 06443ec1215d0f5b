// The methods of kcs.v1.PlanningService: decode, call, encode.
#pragma once

#include <grpcpp/support/byte_buffer.h>
#include <kcs/v1/planning.grpc.pb.h>

#include <memory>

#include "server/service/calls.h"
#include "server/service/cancel_watch.h"
#include "server/service/caps.h"
#include "server/service/gate.h"
#include "server/service/plans.h"

namespace kcs::service {

class PlanningService final : public v1::PlanningService::Service {
 public:
  // Keeps references to all of them.
  PlanningService(Plans& plans, const Caps& caps, Calls& calls);

  grpc::Status GetPlan(grpc::ServerContext* context, const v1::GetPlanRequest* request, v1::Plan* plan) override;
  grpc::Status ListPlans(grpc::ServerContext* context, const v1::ListPlansRequest* request,
                         v1::ListPlansResponse* response) override;
  grpc::Status WatchPlan(grpc::ServerContext* context, const v1::WatchPlanRequest* request,
                         grpc::ServerWriter<v1::PlanProgress>* writer) override;
  grpc::Status DeletePlan(grpc::ServerContext* context, const v1::DeletePlanRequest* request,
                          google::protobuf::Empty* nothing) override;
  grpc::Status StreamSetpoints(grpc::ServerContext* context, const v1::StreamSetpointsRequest* request,
                               grpc::ServerWriter<v1::SetpointBatch>* writer) override;
  grpc::Status DescribeCorners(grpc::ServerContext* context, const v1::DescribeCornersRequest* request,
                               grpc::ServerWriter<v1::CornerBatch>* writer) override;

 private:
  using UploadReader = grpc::ServerReader<grpc::ByteBuffer>;
  using LiveStream = grpc::ServerReaderWriter<v1::PlanLiveResponse, grpc::ByteBuffer>;

  // Stand in for CreatePlan and PlanLive. They parse the messages themselves, because gRPC's own reader takes one that
  // it cannot parse for the end of the upload: the beginning of a path would be planned as if it were the whole.
  grpc::Status create_plan(grpc::ServerContext* context, UploadReader* reader, v1::Plan* plan);
  grpc::Status plan_live(grpc::ServerContext* context, LiveStream* stream);

  // Has `handler` called for a method.
  void handle(const char* method, std::unique_ptr<grpc::internal::MethodHandler> handler);

  // That were sent.
  void count_setpoints(const v1::SetpointBatch& batch) const;

  Plans& plans_;
  const Caps& caps_;
  Calls& calls_;
  Gate uploads_;
  Gate streams_;
  Gate live_streams_;
  CancelWatch cancel_watch_;
};

}  // namespace kcs::service
