// The methods of kcs.v1.PlanningService: decode, call, encode.
#pragma once

#include <grpcpp/support/byte_buffer.h>
#include <kcs/v1/planning.grpc.pb.h>

#include <atomic>
#include <memory>
#include <stop_token>
#include <string>
#include <string_view>

#include "server/service/access_control.h"
#include "server/service/caller.h"
#include "server/service/cancel_watch.h"
#include "server/service/caps.h"
#include "server/service/gate.h"
#include "server/service/observation.h"
#include "server/service/plans.h"

namespace kcs::service {

class PlanningService final : public v1::PlanningService::Service {
 public:
  // Keeps references to all of them.
  PlanningService(Plans& plans, const Caps& caps, const AccessControl& access, const Observation& observation);

  // Refuses every call from now on; those that run go on.
  void close() { closed_ = true; }
  // Ends the calls that run, with UNAVAILABLE: those that wait for a plan or for the time to send, and streams when
  // what they are sending is taken.
  void end_calls() { end_calls_.request_stop(); }
  // Whether no call runs.
  bool idle() const { return running_ == 0; }

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

  // Runs `work` for a caller who may call this method. It takes the call's record and the Caller and returns a
  // grpc::Status; no exception gets out, as none may cross into gRPC. Counts and logs the call.
  template <typename Work>
  grpc::Status answer(std::string_view method, grpc::ServerContext& context, const Work& work);

  // That were sent.
  void count_setpoints(const v1::SetpointBatch& batch) const;

  // Throws Cancelled once the client has gone, Stopping once the server ends its calls.
  void require_wanted(const grpc::ServerContext& context) const;

  Plans& plans_;
  const Caps& caps_;
  const AccessControl& access_;
  const Observation& observation_;
  Gate uploads_;
  Gate streams_;
  Gate live_streams_;
  CancelWatch cancel_watch_;
  std::atomic<bool> closed_ = false;
  std::atomic<int> running_ = 0;
  std::stop_source end_calls_;
};

}  // namespace kcs::service
