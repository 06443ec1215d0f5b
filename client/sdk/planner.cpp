#include "client/sdk/planner.h"

#include <fmt/core.h>
#include <grpcpp/channel.h>
#include <grpcpp/client_context.h>
#include <grpcpp/create_channel.h>
#include <grpcpp/security/credentials.h>

#include <algorithm>
#include <functional>
#include <istream>
#include <utility>

#include "client/sdk/messages.h"
#include "client/sdk/setpoint_call.h"
#include "client/sdk/status_error.h"

namespace kcs::client {
namespace {

// Small enough to keep memory low and to stay far below gRPC's largest message of 4 MiB.
constexpr std::size_t kGcodeBytesPerMessage = 1 << 18;
constexpr std::size_t kPointsPerMessage = 8192;

void check_entries(std::string_view name, std::size_t entries, std::size_t points, bool single_allowed) {
  if (entries == 0 || entries == points || (single_allowed && entries == 1)) return;
  throw Error("INVALID_ARGUMENT", fmt::format("{} has {} entries for {} points; give {}one per point, or none", name,
                                              entries, points, single_allowed ? "one for all, " : ""));
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
  v1::PlanningService::Stub& stub() {
    if (!address_.empty()) await_server();
    return *stub_;
  }

  void check(const grpc::Status& status) const {
    if (!status.ok()) throw_error(status, address_);
  }

  // Sends the options, then what `next_piece` puts into the request until it returns false.
  Plan create(const PlanOptions& options, const std::function<bool(v1::CreatePlanRequest&)>& next_piece) {
    v1::Plan plan;
    grpc::ClientContext context;
    const auto writer = stub().CreatePlan(&context, &plan);
    v1::CreatePlanRequest request;
    *request.mutable_options() = to_message(options);
    // A write fails when the server has refused the request already; Finish() then says why.
    for (bool open = writer->Write(request); open && next_piece(request);) open = writer->Write(request);
    writer->WritesDone();
    check(writer->Finish());
    return from_message(plan);
  }

  SetpointStream stream(const v1::StreamSetpointsRequest& request) {
    stub();
    return SetpointStream(std::make_unique<SetpointStream::Call>(stub_, address_, request));
  }

  // For questions that a server answers at once.
  void set_deadline(grpc::ClientContext& context) const {
    if (!address_.empty()) context.set_deadline(std::chrono::system_clock::now() + patience_);
  }

 private:
  // A refused connection is reported at once, a host that does not answer when the patience is over.
  void await_server() {
    const auto deadline = std::chrono::system_clock::now() + patience_;
    grpc_connectivity_state state = channel_->GetState(/*try_to_connect=*/true);
    while (state != GRPC_CHANNEL_READY) {
      if (state == GRPC_CHANNEL_TRANSIENT_FAILURE || !channel_->WaitForStateChange(state, deadline)) {
        throw Error("UNAVAILABLE", fmt::format("no kcsd answers at {0}; start one with: kcsd --listen {0}", address_));
      }
      state = channel_->GetState(/*try_to_connect=*/true);
    }
  }

  std::shared_ptr<grpc::Channel> channel_;
  std::shared_ptr<v1::PlanningService::Stub> stub_;
  std::string address_;
  std::chrono::milliseconds patience_;
};

Planner::Planner(const std::string& address, std::chrono::milliseconds patience)
    : connection_(std::make_unique<Connection>(grpc::CreateChannel(address, grpc::InsecureChannelCredentials()),
                                               address, patience)) {}

Planner::Planner(std::shared_ptr<grpc::Channel> channel)
    : connection_(std::make_unique<Connection>(std::move(channel), "", std::chrono::milliseconds::zero())) {}

Planner::Planner(Planner&&) noexcept = default;
Planner& Planner::operator=(Planner&&) noexcept = default;
Planner::~Planner() = default;

Plan Planner::plan_gcode(std::istream& program, const PlanOptions& options) {
  return connection_->create(options, [&program](v1::CreatePlanRequest& request) {
    std::string& piece = *request.mutable_gcode();
    piece.resize(kGcodeBytesPerMessage);
    program.read(piece.data(), static_cast<std::streamsize>(piece.size()));
    if (program.bad()) throw std::ios_base::failure("the program cannot be read to its end");
    piece.resize(static_cast<std::size_t>(program.gcount()));
    return !piece.empty();
  });
}

Plan Planner::plan_points(const PointPath& path, const PlanOptions& options) {
  const std::size_t axes = std::max<std::size_t>(options.machine.axes, 1);
  const std::size_t points = (path.points_mm.size() + axes - 1) / axes;
  check_entries("feed_mm_s", path.feed_mm_s.size(), points, true);
  check_entries("tolerance_mm", path.tolerance_mm.size(), points, true);
  check_entries("line", path.line.size(), points, false);
  for (const Stop& stop : path.stops) {
    if (stop.point < points) continue;
    throw Error("INVALID_ARGUMENT",
                fmt::format("stops names point {}, but the path has {} points, counted from 0", stop.point, points));
  }
  std::size_t first = 0;
  return connection_->create(options, [&](v1::CreatePlanRequest& request) {
    if (first >= points) return false;
    *request.mutable_path() = to_message(path, axes, first, kPointsPerMessage);
    first += kPointsPerMessage;
    return true;
  });
}

Plan Planner::get(const std::string& name) {
  v1::GetPlanRequest request;
  request.set_name(name);
  v1::Plan plan;
  v1::PlanningService::Stub& stub = connection_->stub();
  grpc::ClientContext context;
  connection_->set_deadline(context);
  connection_->check(stub.GetPlan(&context, request, &plan));
  return from_message(plan);
}

void Planner::remove(const std::string& name) {
  v1::DeletePlanRequest request;
  request.set_name(name);
  google::protobuf::Empty nothing;
  v1::PlanningService::Stub& stub = connection_->stub();
  grpc::ClientContext context;
  connection_->set_deadline(context);
  connection_->check(stub.DeletePlan(&context, request, &nothing));
}

std::vector<Corner> Planner::corners(const std::string& name) {
  v1::DescribeCornersRequest request;
  request.set_name(name);
  v1::PlanningService::Stub& stub = connection_->stub();
  grpc::ClientContext context;
  const auto reader = stub.DescribeCorners(&context, request);
  std::vector<Corner> corners;
  for (v1::CornerBatch batch; reader->Read(&batch);) {
    for (const v1::Corner& corner : batch.corners()) corners.push_back(from_message(corner));
  }
  connection_->check(reader->Finish());
  return corners;
}

SetpointStream Planner::stream_setpoints(const std::string& name, const StreamOptions& options) {
  return connection_->stream(to_message(name, options));
}

}  // namespace kcs::client
