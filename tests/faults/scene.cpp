#include "tests/faults/scene.h"

#include <fmt/format.h>
#include <signal.h>

#include <stdexcept>
#include <thread>

#include "client/sdk/machine_key.h"

namespace kcs::faults {
namespace {

using std::chrono::milliseconds;
using std::chrono::steady_clock;

constexpr std::chrono::seconds kPatience{60}, kLongestRun{600};
constexpr milliseconds kLookAgain{5}, kSeldom{200};  // the latter takes nothing of a server that is measured
constexpr std::chrono::duration<int, std::milli> kReconnect{100};

struct Call : grpc::ClientContext {
  Call() { set_deadline(std::chrono::system_clock::now() + kPatience); }
};

struct MachineCall : Call {
  MachineCall() { client::say_machine(*this, "machines/bench"); }
};

// Until `attempt` returns an OK status; throws with the last one.
template <typename Attempt>
void insist(const std::string& what, const Attempt& attempt) {
  grpc::Status status;
  for (const auto end = steady_clock::now() + kPatience; steady_clock::now() < end;) {
    status = attempt();
    if (status.ok()) return;
    std::this_thread::sleep_for(kLookAgain);
  }
  throw std::runtime_error(what + ": " + status.error_message());
}

template <typename Request>
Request named(const std::string& run) {
  Request request;
  request.set_name(run);
  return request;
}

bool is_over(const v1::Run& run) { return run.state() >= v1::RUN_STATE_FINISHED; }

bool is_attached(const v1::Run& run) { return run.machine_state() != v1::MACHINE_STATE_UNSPECIFIED; }

}  // namespace

Scene::Scene(std::unique_ptr<Drives> drives, const ProgramCursor& cursor, bool scrambles,
             std::unique_ptr<Service> service)
    : drives_(std::move(drives)), cursor_(cursor), service_(std::move(service)) {
  const std::string& address = service_->address();
  grpc::ChannelArguments arguments;  // soon there again when the server is
  arguments.SetInt(GRPC_ARG_INITIAL_RECONNECT_BACKOFF_MS, kReconnect.count());
  arguments.SetInt(GRPC_ARG_MAX_RECONNECT_BACKOFF_MS, kReconnect.count());
  const auto channel = grpc::CreateCustomChannel(address, grpc::InsecureChannelCredentials(), arguments);
  machines_ = v1::MachineService::NewStub(channel);
  planning_ = v1::PlanningService::NewStub(channel);
  if (scrambles) scrambler_ = std::make_unique<Scrambler>(address);
  const int port = std::stoi(address.substr(address.rfind(':') + 1));
  cable_ = std::make_unique<test::Cable>(scrambles ? scrambler_->port() : port);
  start_gateway();
}

void Scene::start_gateway() {
  gateway_ = std::make_unique<test::ChildProcess>(drives_->gateway_command(cable_->address()));
}

void Scene::restart_gateway(milliseconds down) {
  gateway_->send_signal(SIGKILL);
  gateway_->wait();
  std::this_thread::sleep_for(down);
  start_gateway();
}

std::string Scene::create_plan(const planning::Toolpath& path) {
  v1::Plan plan;
  insist("no plan is made", [&] {
    Call call;
    const auto writer = planning_->CreatePlan(&call, &plan);
    for (const v1::CreatePlanRequest& message : request_of(path)) writer->Write(message);
    writer->WritesDone();
    return writer->Finish();
  });
  return plan.name();
}

void Scene::begin(const planning::Toolpath& path) {
  v1::RunPlanRequest request;
  request.set_machine("machines/bench");
  request.set_plan(create_plan(path));
  planning::Plan plan = make_plan(path);
  runs_.push_back({.plan = std::move(plan), .begun = drives_->now()});
  insist("the run does not begin", [&] {
    MachineCall call;
    v1::Run run;
    const grpc::Status status = machines_->RunPlan(&call, request, &run);
    run_ = run.name();
    return status;
  });
}

v1::Run Scene::run() {
  v1::Run run;
  insist("nothing is known of the run", [&] {
    MachineCall call;
    return machines_->GetRun(&call, named<v1::GetRunRequest>(run_), &run);
  });
  return run;
}

motion::Vector Scene::machine_position() {
  v1::ListMachinesResponse machines;
  insist("where the machine is, is not known", [&] {
    MachineCall call;
    const grpc::Status status = machines_->ListMachines(&call, {}, &machines);
    if (!status.ok() || machines.machines_size() == 1) return status;
    return grpc::Status(grpc::StatusCode::UNAVAILABLE, "the machine is not attached");
  });
  const auto& position = machines.machines(0).report().position_mm();
  return {position[0], position[1], position[2]};
}

void Scene::hold() {
  MachineCall call;
  v1::Run run;
  machines_->HoldRun(&call, named<v1::HoldRunRequest>(run_), &run);
}

void Scene::resume() {
  MachineCall call;
  v1::Run run;
  machines_->ResumeRun(&call, named<v1::ResumeRunRequest>(run_), &run);
}

void Scene::abort() {
  MachineCall call;
  v1::Run run;
  machines_->AbortRun(&call, named<v1::AbortRunRequest>(run_), &run);
}

void Scene::set_override(double percent) {
  MachineCall call;
  auto request = named<v1::SetFeedOverrideRequest>(run_);
  request.set_feed_override_percent(percent);
  v1::Run run;
  machines_->SetFeedOverride(&call, request, &run);
}

void Scene::wait_until(const std::function<bool(const v1::Run&)>& is_so, const char* what,
                       std::chrono::seconds patience, milliseconds look_again) {
  v1::Run seen;
  for (const auto end = steady_clock::now() + patience; steady_clock::now() < end;) {
    seen = run();
    if (is_so(seen)) return;
    std::this_thread::sleep_for(look_again);
  }
  throw std::runtime_error(fmt::format("the run {}: {}\n{}", what, seen.ShortDebugString(), gateway_->errors()));
}

void Scene::wait_for(v1::RunState state) {
  wait_until([state](const v1::Run& run) { return run.state() == state || is_over(run); }, "does not become so",
             kPatience);
}

void Scene::note_end(const v1::Run& run) {
  if (run.state() == v1::RUN_STATE_FAILED) {
    throw std::runtime_error("the run failed: " + run.ShortDebugString() + "\n" + gateway_->errors());
  }
  runs_.back().complete = run.state() == v1::RUN_STATE_FINISHED;
}

void Scene::go_on() {
  if (run_.empty()) begin(cursor_.next());
  if (const v1::Run last = run(); is_over(last)) {
    note_end(last);
    begin(runs_.back().complete ? cursor_.next() : cursor_.next_from(machine_position()));
  }
  wait_until(
      [this](const v1::Run& run) {
        if (is_attached(run) && run.state() == v1::RUN_STATE_HELD) resume();
        return is_over(run) || (is_attached(run) && run.state() == v1::RUN_STATE_RUNNING);
      },
      "does not go on", kPatience);
}

void Scene::run_to_end() {
  wait_until(
      [this](const v1::Run& run) {
        if (is_attached(run) && run.state() == v1::RUN_STATE_HELD) resume();
        return is_over(run);
      },
      "does not come to its end", kLongestRun, kSeldom);
  note_end(run());
}

void Scene::finish() {
  gateway_->send_signal(SIGTERM);
  if (const int code = gateway_->wait(); code != 0) {
    throw std::runtime_error(fmt::format("the gateway ended with {}:\n{}", code, gateway_->errors()));
  }
}

}  // namespace kcs::faults
