#include "client/sdk/machines.h"

#include <grpcpp/channel.h>

#include <chrono>
#include <type_traits>
#include <utility>

#include "client/sdk/call_context.h"
#include "client/sdk/channel.h"
#include "client/sdk/machine_key.h"
#include "client/sdk/machine_messages.h"
#include "client/sdk/server_link.h"
#include "kcs/v1/machine.grpc.pb.h"

namespace kcs::client {
namespace {

// Whoever operates a machine wants a server that comes back at once.
constexpr ChannelPace kPace{.first_pause = std::chrono::milliseconds(250), .longest_pause = std::chrono::seconds(1)};

}  // namespace

class Machines::Link {
 public:
  using Stub = v1::MachineService::Stub;

  explicit Link(ServerLink server)
      : server_(std::move(server)), stub_(v1::MachineService::NewStub(server_.channel())) {}

  // Asks what the server answers at once; but for a run, whose plan may have to be made again first.
  template <typename Request, typename Response>
  Response ask(grpc::Status (Stub::*method)(grpc::ClientContext*, const Request&, Response*), const Request& request) {
    server_.await_server({});
    grpc::ClientContext context;
    if constexpr (!std::is_same_v<Request, v1::RunPlanRequest>) server_.set_deadline(context);
    if constexpr (requires { request.machine(); }) {
      say_machine(context, request.machine());
    } else if constexpr (requires { request.name(); }) {
      say_machine(context, request.name());
    }
    Response response;
    server_.check((*stub_.*method)(&context, request, &response));
    return response;
  }

  Run watch(const v1::WatchRunRequest& request, const std::function<void(const Run&)>& on_change,
            const std::stop_token& stop) {
    server_.await_server(stop);
    CallContext context(stop);
    say_machine(context, request.name());
    const auto reader = stub_->WatchRun(&context, request);
    Run run;
    try {
      for (v1::Run message; reader->Read(&message);) {
        run = from_message(message);
        on_change(run);
      }
    } catch (...) {
      context.TryCancel();
      reader->Finish();
      throw;
    }
    server_.check(reader->Finish());
    return run;
  }

 private:
  ServerLink server_;
  std::unique_ptr<Stub> stub_;
};

namespace {

template <typename Request>
Request request_for(const std::string& run) {
  Request request;
  request.set_name(run);
  return request;
}

}  // namespace

Machines::Machines(const Connection& connection) : Machines(ServerLink(open_channel(connection, kPace), connection)) {}

Machines::Machines(const ServerLink& server) : link_(std::make_unique<Link>(server)) {}

Machines::Machines(Machines&&) noexcept = default;
Machines& Machines::operator=(Machines&&) noexcept = default;
Machines::~Machines() = default;

std::vector<AttachedMachine> Machines::list() {
  const v1::ListMachinesResponse response = link_->ask(&Link::Stub::ListMachines, v1::ListMachinesRequest());
  std::vector<AttachedMachine> machines;
  for (const v1::AttachedMachine& machine : response.machines()) machines.push_back(from_message(machine));
  return machines;
}

Run Machines::run_plan(const std::string& machine, const std::string& plan,
                       std::optional<double> feed_override_percent) {
  v1::RunPlanRequest request;
  request.set_machine(machine);
  request.set_plan(plan);
  if (feed_override_percent) request.set_feed_override_percent(*feed_override_percent);
  return from_message(link_->ask(&Link::Stub::RunPlan, request));
}

Run Machines::get(const std::string& run) {
  return from_message(link_->ask(&Link::Stub::GetRun, request_for<v1::GetRunRequest>(run)));
}

Run Machines::hold(const std::string& run) {
  return from_message(link_->ask(&Link::Stub::HoldRun, request_for<v1::HoldRunRequest>(run)));
}

Run Machines::resume(const std::string& run, bool take_over) {
  auto request = request_for<v1::ResumeRunRequest>(run);
  request.set_take_over(take_over);
  return from_message(link_->ask(&Link::Stub::ResumeRun, request));
}

Run Machines::abort(const std::string& run) {
  return from_message(link_->ask(&Link::Stub::AbortRun, request_for<v1::AbortRunRequest>(run)));
}

Run Machines::set_feed_override(const std::string& run, double percent, bool take_over) {
  auto request = request_for<v1::SetFeedOverrideRequest>(run);
  request.set_feed_override_percent(percent);
  request.set_take_over(take_over);
  return from_message(link_->ask(&Link::Stub::SetFeedOverride, request));
}

Run Machines::watch(const std::string& run, const std::function<void(const Run&)>& on_change,
                    const std::stop_token& stop) {
  return link_->watch(request_for<v1::WatchRunRequest>(run), on_change, stop);
}

}  // namespace kcs::client
