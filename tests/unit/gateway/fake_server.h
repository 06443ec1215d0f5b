// A planning service on a loopback socket that misbehaves just as a test wants it to.
#pragma once

#include <grpcpp/grpcpp.h>

#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <thread>

#include "kcs/v1/planning.grpc.pb.h"

namespace kcs::gateway {

// Keeps one plan for two axes whose setpoint i is at X = i, Y = −i.
class FakeServer : public v1::PlanningService::Service {
 public:
  static constexpr const char* kPlan = "plans/counting";
  static constexpr std::uint64_t kSetpoints = 1000;

  using Request = v1::StreamSetpointsRequest;
  using Writer = grpc::ServerWriter<v1::SetpointBatch>;

  FakeServer() {
    int port = 0;
    grpc::ServerBuilder builder;
    builder.AddListeningPort("127.0.0.1:0", grpc::InsecureServerCredentials(), &port);
    builder.RegisterService(this);
    server_ = builder.BuildAndStart();
    address_ = "127.0.0.1:" + std::to_string(port);
  }
  ~FakeServer() override { server_->Shutdown(std::chrono::system_clock::now()); }

  const std::string& address() const { return address_; }

  // What the calls do; to be set before they come.
  std::function<grpc::Status(grpc::ServerContext&, const Request&, Writer&)> on_stream =
      [](grpc::ServerContext&, const Request& request, Writer& writer) {
        writer.Write(batch(request.first_index(), last_of(request)));
        return grpc::Status::OK;
      };
  std::function<grpc::Status(grpc::ServerContext&)> on_get = [](grpc::ServerContext&) { return grpc::Status::OK; };
  std::function<grpc::Status(grpc::ServerContext&)> on_create = on_get;
  double end_speed = 0;  // of the plan, mm/s

  // Does not answer until the client gives up.
  static grpc::Status hang(grpc::ServerContext& context) {
    while (!context.IsCancelled()) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    return grpc::Status::CANCELLED;
  }

  // The setpoints first … last.
  static v1::SetpointBatch batch(std::uint64_t first, std::uint64_t last) {
    v1::SetpointBatch batch;
    batch.set_first_index(first);
    batch.set_setpoint_count(kSetpoints);
    for (const double sign : {1.0, -1.0}) {
      v1::Column& column = *batch.add_position_mm();
      for (std::uint64_t i = first; i <= last; ++i) column.add_values(sign * static_cast<double>(i));
    }
    return batch;
  }

  static std::uint64_t last_of(const Request& request) { return std::min(request.last_index(), kSetpoints - 1); }

 private:
  grpc::Status GetPlan(grpc::ServerContext* context, const v1::GetPlanRequest*, v1::Plan* plan) override {
    plan->set_name(kPlan);
    plan->mutable_options()->mutable_machine()->set_axes(2);
    plan->mutable_options()->set_end_speed_mm_s(end_speed);
    plan->mutable_summary()->set_cycle_time_s(1);
    return on_get(*context);
  }

  grpc::Status CreatePlan(grpc::ServerContext* context, grpc::ServerReader<v1::CreatePlanRequest>*,
                          v1::Plan* plan) override {
    plan->set_name(kPlan);
    plan->mutable_options()->mutable_machine()->set_axes(2);
    return on_create(*context);
  }

  grpc::Status StreamSetpoints(grpc::ServerContext* context, const Request* request, Writer* writer) override {
    return on_stream(*context, *request, *writer);
  }

  std::string address_;
  std::unique_ptr<grpc::Server> server_;
};

}  // namespace kcs::gateway
