// The methods of kcs.v1.PlanningService: decode, call, encode.
#pragma once

#include <grpcpp/support/byte_buffer.h>
#include <kcs/v1/planning.grpc.pb.h>

#include <atomic>
#include <memory>
#include <string>
#include <string_view>

#include "server/jobs/plan_desk.h"
#include "server/service/caps.h"
#include "server/service/gate.h"
#include "server/service/observation.h"

namespace kcs::service {

class PlanningService final : public v1::PlanningService::Service {
 public:
  // Keeps references to all.
  PlanningService(jobs::PlanDesk& desk, const Caps& caps, const Observation& observation);

  // Refuses every call from now on; those that run go on.
  void close() { closed_ = true; }
  // Whether no call runs.
  bool idle() const { return running_ == 0; }

  grpc::Status GetPlan(grpc::ServerContext* context, const v1::GetPlanRequest* request, v1::Plan* plan) override;
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

  // Runs `work`, which takes the call's record and returns a grpc::Status, and lets no exception out: none may cross
  // into gRPC. Counts and logs the call.
  template <typename Work>
  grpc::Status answer(std::string_view method, grpc::ServerContext& context, const Work& work);

  // That were sent.
  void count_setpoints(const v1::SetpointBatch& batch) const;

  // Throws planning::InvalidInput without a name, NotKept if there is no such plan.
  jobs::PlanPointer find(const std::string& name);

  jobs::PlanDesk& desk_;
  const Caps& caps_;
  const Observation& observation_;
  Gate uploads_;
  Gate streams_;
  Gate live_streams_;
  std::atomic<bool> closed_ = false;
  std::atomic<int> running_ = 0;
};

}  // namespace kcs::service
