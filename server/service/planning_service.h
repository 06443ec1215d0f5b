// The methods of kcs.v1.PlanningService: decode, call, encode.
#pragma once

#include <grpcpp/support/byte_buffer.h>
#include <kcs/v1/planning.grpc.pb.h>

#include <atomic>
#include <memory>
#include <stop_token>
#include <string>
#include <string_view>

#include "server/jobs/plan_desk.h"
#include "server/jobs/plan_store.h"
#include "server/service/access_control.h"
#include "server/service/cancel_watch.h"
#include "server/service/caps.h"
#include "server/service/gate.h"
#include "server/service/observation.h"
#include "server/service/plan_owners.h"

namespace kcs::service {

class PlanningService final : public v1::PlanningService::Service {
 public:
  // Keeps references to all of them. plans: where the desk keeps its plans.
  PlanningService(jobs::PlanDesk& desk, jobs::PlanStore& plans, const Caps& caps, const AccessControl& access,
                  const Observation& observation);

  // Refuses every call from now on; those that run go on.
  void close() { closed_ = true; }
  // Ends the streams of setpoints that run: those that wait at once, the others when what they are sending is taken.
  void end_streams() { end_streams_.request_stop(); }
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

  // Runs `work` for a caller who may call this method. It takes the call's record and the caller's Identity and returns
  // a grpc::Status; no exception gets out, as none may cross into gRPC. Counts and logs the call.
  template <typename Work>
  grpc::Status answer(std::string_view method, grpc::ServerContext& context, const Work& work);

  // That were sent.
  void count_setpoints(const v1::SetpointBatch& batch) const;

  // The caller's plan of that name. Throws planning::InvalidInput without a name, NotKept if he has no such plan.
  jobs::PlanPointer owned_plan(const security::Identity& caller, const std::string& name);

  jobs::PlanDesk& desk_;
  jobs::PlanStore& plans_;
  const Caps& caps_;
  const AccessControl& access_;
  const Observation& observation_;
  PlanOwners owners_;
  Gate uploads_;
  Gate streams_;
  Gate live_streams_;
  CancelWatch cancel_watch_;
  std::atomic<bool> closed_ = false;
  std::atomic<int> running_ = 0;
  std::stop_source end_streams_;
};

}  // namespace kcs::service
