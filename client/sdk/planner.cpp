#include "client/sdk/planner.h"

#include <fmt/core.h>
#include <grpcpp/channel.h>
#include <grpcpp/create_channel.h>
#include <grpcpp/security/credentials.h>

#include <algorithm>
#include <functional>
#include <istream>
#include <utility>

#include "client/sdk/call_context.h"
#include "client/sdk/live_call.h"
#include "client/sdk/messages.h"
#include "client/sdk/setpoint_call.h"
#include "client/sdk/status_error.h"

namespace kcs::client {
namespace {

// A server that answers a ping keeps a call alive, even one that plans for an hour; one that does not ends it.
constexpr int kPingAfterSilenceMs = 10'000;
constexpr int kPingTimeoutMs = 10'000;

constexpr std::chrono::milliseconds kLookForStop{50};  // while waiting for a connection

std::shared_ptr<grpc::Channel> make_channel(const std::string& address) {
  grpc::ChannelArguments arguments;
  arguments.SetInt(GRPC_ARG_KEEPALIVE_TIME_MS, kPingAfterSilenceMs);
  arguments.SetInt(GRPC_ARG_KEEPALIVE_TIMEOUT_MS, kPingTimeoutMs);
  arguments.SetInt(GRPC_ARG_HTTP2_MAX_PINGS_WITHOUT_DATA, 0);  // any number of them
  return grpc::CreateCustomChannel(address, grpc::InsecureChannelCredentials(), arguments);
}

}  // namespace

class Planner::Connection {
 public:
  // An empty address: the channel leads to a server inside the process, which is always there.
  Connection(std::shared_ptr<grpc::Channel> channel, std::string address, std::chrono::milliseconds patience)
      : channel_(std::move(channel)),
        stub_(v1::PlanningService::NewStub(channel_)),
        address_(std::move(address)),
        patience_(patience) {}

  // The stub, when the server can be reached; throws Error if it cannot.
  v1::PlanningService::Stub& stub(const std::stop_token& stop) {
    if (!address_.empty()) await_server(stop);
    return *stub_;
  }

  void check(const grpc::Status& status) const {
    if (!status.ok()) throw_error(status, address_);
  }

  // Sends the options, then what `next_piece` puts into the request until it returns false.
  Plan create(const PlanOptions& options, const std::stop_token& stop,
              const std::function<bool(v1::CreatePlanRequest&)>& next_piece) {
    v1::Plan plan;
    CallContext context(stop);
    const auto writer = stub(stop).CreatePlan(&context, &plan);
    v1::CreatePlanRequest request;
    *request.mutable_options() = to_message(options);
    // A write fails when the server has refused the request already; Finish() then says why.
    for (bool open = writer->Write(request); open && next_piece(request);) open = writer->Write(request);
    writer->WritesDone();
    check(writer->Finish());
    return from_message(plan);
  }

  SetpointStream stream(const v1::StreamSetpointsRequest& request, const std::stop_token& stop) {
    stub(stop);
    return SetpointStream(std::make_unique<SetpointStream::Call>(stub_, address_, request, stop));
  }

  LiveStream live(const PlanOptions& options, const LiveOptions& output, const std::stop_token& stop) {
    stub(stop);
    v1::PlanLiveRequest request;
    *request.mutable_options() = to_message(options);
    *request.mutable_output() = to_message(output);
    return LiveStream(std::make_unique<LiveStream::Call>(stub_, address_, request, stop));
  }

  // For questions that a server answers at once.
  void set_deadline(grpc::ClientContext& context) const {
    if (!address_.empty()) context.set_deadline(std::chrono::system_clock::now() + patience_);
  }

 private:
  // A refused connection is reported at once, a host that does not answer when the patience is over.
  void await_server(const std::stop_token& stop) {
    using Clock = std::chrono::system_clock;  // gRPC's deadlines go by it
    const auto deadline = Clock::now() + patience_;
    while (true) {
      const grpc_connectivity_state state = channel_->GetState(/*try_to_connect=*/true);
      if (state == GRPC_CHANNEL_READY) return;
      if (stop.stop_requested()) throw Error("CANCELLED", fmt::format("stopped while connecting to {}", address_));
      if (state == GRPC_CHANNEL_TRANSIENT_FAILURE || Clock::now() >= deadline) {
        throw Error("UNAVAILABLE", fmt::format("no kcsd answers at {0}; start one with: kcsd --listen {0}", address_));
      }
      channel_->WaitForStateChange(state, std::min(deadline, Clock::now() + kLookForStop));
    }
  }

  std::shared_ptr<grpc::Channel> channel_;
  std::shared_ptr<v1::PlanningService::Stub> stub_;
  std::string address_;
  std::chrono::milliseconds patience_;
};

Planner::Planner(const std::string& address, std::chrono::milliseconds patience)
    : connection_(std::make_unique<Connection>(make_channel(address), address, patience)) {}

Planner::Planner(std::shared_ptr<grpc::Channel> channel)
    : connection_(std::make_unique<Connection>(std::move(channel), "", std::chrono::milliseconds::zero())) {}

Planner::Planner(Planner&&) noexcept = default;
Planner& Planner::operator=(Planner&&) noexcept = default;
Planner::~Planner() = default;

Plan Planner::plan_gcode(std::istream& program, const PlanOptions& options, const std::stop_token& stop) {
  return connection_->create(options, stop, [&program](v1::CreatePlanRequest& request) {
    std::string& piece = *request.mutable_gcode();
    piece.resize(kGcodeBytesPerMessage);
    program.read(piece.data(), static_cast<std::streamsize>(piece.size()));
    if (program.bad()) throw std::ios_base::failure("the program cannot be read to its end");
    piece.resize(static_cast<std::size_t>(program.gcount()));
    return !piece.empty();
  });
}

Plan Planner::plan_points(const PointPath& path, const PlanOptions& options, const std::stop_token& stop) {
  const std::size_t axes = std::max<std::size_t>(options.machine.axes, 1);
  const std::size_t points = count_points(path, axes);
  std::size_t first = 0;
  return connection_->create(options, stop, [&](v1::CreatePlanRequest& request) {
    if (first >= points) return false;
    *request.mutable_path() = to_message(path, axes, first, kPointsPerMessage);
    first += kPointsPerMessage;
    return true;
  });
}

Plan Planner::get(const std::string& name, const std::stop_token& stop) {
  v1::GetPlanRequest request;
  request.set_name(name);
  v1::Plan plan;
  v1::PlanningService::Stub& stub = connection_->stub(stop);
  CallContext context(stop);
  connection_->set_deadline(context);
  connection_->check(stub.GetPlan(&context, request, &plan));
  return from_message(plan);
}

void Planner::remove(const std::string& name, const std::stop_token& stop) {
  v1::DeletePlanRequest request;
  request.set_name(name);
  google::protobuf::Empty nothing;
  v1::PlanningService::Stub& stub = connection_->stub(stop);
  CallContext context(stop);
  connection_->set_deadline(context);
  connection_->check(stub.DeletePlan(&context, request, &nothing));
}

std::vector<Corner> Planner::corners(const std::string& name, const std::stop_token& stop) {
  v1::DescribeCornersRequest request;
  request.set_name(name);
  v1::PlanningService::Stub& stub = connection_->stub(stop);
  CallContext context(stop);
  const auto reader = stub.DescribeCorners(&context, request);
  std::vector<Corner> corners;
  for (v1::CornerBatch batch; reader->Read(&batch);) {
    for (const v1::Corner& corner : batch.corners()) corners.push_back(from_message(corner));
  }
  connection_->check(reader->Finish());
  return corners;
}

SetpointStream Planner::stream_setpoints(const std::string& name, const StreamOptions& options,
                                         const std::stop_token& stop) {
  return connection_->stream(to_message(name, options), stop);
}

LiveStream Planner::plan_live(const PlanOptions& options, const LiveOptions& output, const std::stop_token& stop) {
  return connection_->live(options, output, stop);
}

}  // namespace kcs::client
