// The methods of kcs.v1.MachineService: decode, call, encode.
#pragma once

#include <kcs/v1/machine.grpc.pb.h>

#include <string_view>

#include "server/service/calls.h"
#include "server/service/caps.h"
#include "server/service/gate.h"
#include "server/service/machine_runs.h"
#include "server/service/machines.h"

namespace kcs::service {

class MachineService final : public v1::MachineService::Service {
 public:
  // Keeps references to all of them.
  MachineService(Machines& machines, MachineRuns& runs, const Caps& caps, Calls& calls);

  grpc::Status AttachMachine(
      grpc::ServerContext* context,
      grpc::ServerReaderWriter<v1::AttachMachineResponse, v1::AttachMachineRequest>* stream) override;
  grpc::Status ListMachines(grpc::ServerContext* context, const v1::ListMachinesRequest* request,
                            v1::ListMachinesResponse* response) override;
  grpc::Status RunPlan(grpc::ServerContext* context, const v1::RunPlanRequest* request, v1::Run* run) override;
  grpc::Status GetRun(grpc::ServerContext* context, const v1::GetRunRequest* request, v1::Run* run) override;
  grpc::Status HoldRun(grpc::ServerContext* context, const v1::HoldRunRequest* request, v1::Run* run) override;
  grpc::Status ResumeRun(grpc::ServerContext* context, const v1::ResumeRunRequest* request, v1::Run* run) override;
  grpc::Status AbortRun(grpc::ServerContext* context, const v1::AbortRunRequest* request, v1::Run* run) override;
  grpc::Status SetFeedOverride(grpc::ServerContext* context, const v1::SetFeedOverrideRequest* request,
                               v1::Run* run) override;
  grpc::Status WatchRun(grpc::ServerContext* context, const v1::WatchRunRequest* request,
                        grpc::ServerWriter<v1::Run>* writer) override;

 private:
  // A method that answers with the run that `work`, which takes the Caller, returns.
  template <typename Work>
  grpc::Status answer(std::string_view method, grpc::ServerContext& context, const std::string& run, v1::Run& answer,
                      const Work& work);

  Machines& machines_;
  MachineRuns& runs_;
  Calls& calls_;
  Gate attaching_, watching_;
};

}  // namespace kcs::service
