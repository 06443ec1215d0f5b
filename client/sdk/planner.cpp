#include "client/sdk/planner.h"

#include <grpcpp/channel.h>

#include <algorithm>
#include <functional>
#include <istream>
#include <utility>

#include "client/sdk/call_context.h"
#include "client/sdk/channel.h"
#include "client/sdk/live_call.h"
#include "client/sdk/messages.h"
#include "client/sdk/server_link.h"
#include "client/sdk/setpoint_call.h"

namespace kcs::client {

class Planner::Link {
 public:
  explicit Link(ServerLink server)
      : server_(std::move(server)), stub_(v1::PlanningService::NewStub(server_.channel())) {}

  // The stub, when the server can be reached; throws Error if it cannot.
  v1::PlanningService::Stub& stub(const std::stop_token& stop) {
    server_.await_server(stop);
    return *stub_;
  }

  void check(const grpc::Status& status) const { server_.check(status); }
  void set_deadline(grpc::ClientContext& context) const { server_.set_deadline(context); }

  // Sends the options, then what `next_piece` puts into the request until it returns false.
  Plan create(const PlanOptions& options, const std::stop_token& stop,
              const std::function<bool(v1::CreatePlanRequest&)>& next_piece) {
    v1::Plan plan;
    CallContext context(stop);
    const auto writer = stub(stop).CreatePlan(&context, &plan);
    v1::CreatePlanRequest request;
    *request.mutable_options() = to_message(options);
    request.set_priority(to_message(options.priority));
    request.set_accept_only(options.accept_only);
    // A write fails when the server has refused the request already; Finish() then says why.
    bool open = writer->Write(request);
    for (request.Clear(); open && next_piece(request);) open = writer->Write(request);
    writer->WritesDone();
    check(writer->Finish());
    return from_message(plan);
  }

  SetpointStream stream(const v1::StreamSetpointsRequest& request, const std::stop_token& stop) {
    stub(stop);
    return SetpointStream(std::make_unique<SetpointStream::Call>(stub_, server_.connection(), request, stop));
  }

  LiveStream live(const PlanOptions& options, const LiveOptions& output, const std::stop_token& stop) {
    stub(stop);
    v1::PlanLiveRequest request;
    *request.mutable_options() = to_message(options);
    *request.mutable_output() = to_message(output);
    return LiveStream(std::make_unique<LiveStream::Call>(stub_, server_.address(), request, stop));
  }

 private:
  ServerLink server_;
  std::shared_ptr<v1::PlanningService::Stub> stub_;
};

Planner::Planner(const std::string& address, std::chrono::milliseconds patience)
    : Planner(Connection{.address = address, .patience = patience}) {}

Planner::Planner(const Connection& connection) : Planner(ServerLink(open_channel(connection), connection)) {}

Planner::Planner(const ServerLink& server) : link_(std::make_unique<Link>(server)) {}

Planner::Planner(Planner&&) noexcept = default;
Planner& Planner::operator=(Planner&&) noexcept = default;
Planner::~Planner() = default;

Plan Planner::plan_gcode(std::istream& program, const PlanOptions& options, const std::stop_token& stop) {
  return link_->create(options, stop, [&program](v1::CreatePlanRequest& request) {
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
  return link_->create(options, stop, [&](v1::CreatePlanRequest& request) {
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
  v1::PlanningService::Stub& stub = link_->stub(stop);
  CallContext context(stop);
  link_->set_deadline(context);
  link_->check(stub.GetPlan(&context, request, &plan));
  return from_message(plan);
}

PlanPage Planner::list(const PlanFilter& filter, const std::string& page_token, int page_size,
                       const std::stop_token& stop) {
  v1::ListPlansRequest request;
  *request.mutable_filter() = to_message(filter);
  request.set_page_token(page_token);
  request.set_page_size(page_size);
  v1::ListPlansResponse response;
  v1::PlanningService::Stub& stub = link_->stub(stop);
  CallContext context(stop);
  link_->set_deadline(context);
  link_->check(stub.ListPlans(&context, request, &response));
  PlanPage page{.plans = {}, .next_page_token = response.next_page_token()};
  for (const v1::Plan& plan : response.plans()) page.plans.push_back(from_message(plan));
  return page;
}

Plan Planner::await(const std::string& name, const std::function<void(const PlanProgress&)>& on_progress,
                    const std::stop_token& stop) {
  v1::WatchPlanRequest request;
  request.set_name(name);
  v1::PlanningService::Stub& stub = link_->stub(stop);
  CallContext context(stop);
  const auto reader = stub.WatchPlan(&context, request);
  for (v1::PlanProgress progress; reader->Read(&progress);) {
    if (on_progress) on_progress(from_message(progress));
  }
  link_->check(reader->Finish());
  return get(name, stop);
}

void Planner::remove(const std::string& name, const std::stop_token& stop) {
  v1::DeletePlanRequest request;
  request.set_name(name);
  google::protobuf::Empty nothing;
  v1::PlanningService::Stub& stub = link_->stub(stop);
  CallContext context(stop);
  link_->set_deadline(context);
  link_->check(stub.DeletePlan(&context, request, &nothing));
}

std::vector<Corner> Planner::corners(const std::string& name, const std::stop_token& stop) {
  v1::DescribeCornersRequest request;
  request.set_name(name);
  v1::PlanningService::Stub& stub = link_->stub(stop);
  CallContext context(stop);
  const auto reader = stub.DescribeCorners(&context, request);
  std::vector<Corner> corners;
  for (v1::CornerBatch batch; reader->Read(&batch);) {
    for (const v1::Corner& corner : batch.corners()) corners.push_back(from_message(corner));
  }
  link_->check(reader->Finish());
  return corners;
}

SetpointStream Planner::stream_setpoints(const std::string& name, const StreamOptions& options,
                                         const std::stop_token& stop) {
  return link_->stream(to_message(name, options), stop);
}

LiveStream Planner::plan_live(const PlanOptions& options, const LiveOptions& output, const std::stop_token& stop) {
  return link_->live(options, output, stop);
}

}  // namespace kcs::client
