#include "tests/faults/scene.h"

#include <fmt/format.h>
#include <signal.h>

#include <array>
#include <chrono>
#include <cmath>
#include <fstream>
#include <stdexcept>
#include <thread>

#include "server/gcode/reader.h"
#include "server/planning/plan_path.h"

namespace kcs::faults {
namespace {

using std::chrono::milliseconds;
using std::chrono::steady_clock;

constexpr std::chrono::seconds kPatience{30};
constexpr double kFeed = 60;  // mm/s
constexpr double kTolerance = 0.02;

// The limits of deploy/machines/machining-center.toml.
const std::array<double, 3> kVelocity = {500, 500, 400}, kAcceleration = {3400, 3400, 2800},
                            kJerk = {35000, 35000, 28000};

v1::CreatePlanRequest options() {
  v1::CreatePlanRequest message;
  v1::PlanOptions& options = *message.mutable_options();
  v1::Machine& machine = *options.mutable_machine();
  machine.set_axes(3);
  for (std::size_t i = 0; i < 3; ++i) {
    machine.add_velocity_mm_s(kVelocity[i]);
    machine.add_acceleration_mm_s2(kAcceleration[i]);
    machine.add_jerk_mm_s3(kJerk[i]);
  }
  options.set_feed_mm_s(kFeed);
  options.set_tolerance_mm(kTolerance);
  return message;
}

Part make_part(const std::string& name, const std::string& gcode) {
  Part part;
  part.name = name;
  part.request = {options(), {}};
  part.request[1].set_gcode(gcode);
  for (Eigen::Index i = 0; i < 3; ++i) {
    const auto axis = static_cast<std::size_t>(i);
    part.limits.velocity[i] = kVelocity[axis];
    part.limits.acceleration[i] = kAcceleration[axis];
    part.limits.jerk[i] = kJerk[axis];
  }
  const planning::PlanOptions options{.limits = part.limits};
  planning::Toolpath path;
  gcode::Reader reader({.feed = kFeed, .tolerance = kTolerance},
                       [&path](const planning::Segment& segment) { path.segments.push_back(segment); });
  reader.read(gcode);
  reader.finish();
  part.plan = planning::plan(path, options);
  return part;
}

struct Call : grpc::ClientContext {
  Call() { set_deadline(std::chrono::system_clock::now() + kPatience); }
};

}  // namespace

Part sharp_part() {
  std::string gcode = "G1 F3600\n";
  for (int i = 1; i <= 3000; ++i) {
    gcode += fmt::format("X{} Y{} Z{}\n", 4 * (i % 50), 11 * (i % 2) + i % 7, (i % 3) * 0.5);
  }
  return make_part("sharp corners", gcode);
}

Part dense_part() {
  std::ifstream in(KCS_SOURCE "/deploy/demo/part.ngc");
  return make_part("dense program", std::string(std::istreambuf_iterator<char>(in), {}));
}

Scene::Scene(const Part& part) : listen_("127.0.0.1:0") {
  start_server();
  listen_ = server_->address();
  cable_ = std::make_unique<test::Cable>(std::stoi(listen_.substr(listen_.rfind(':') + 1)));
  connect();
  std::ofstream(folder_.path() / "gateway.toml") << fmt::format(
      "[machine]\nname = \"bench\"\n[simulated]\nprofile = \"machining-center\"\nfollowing_error_mm = [5, 5, 5]\n");
  gateway_ = std::make_unique<test::ChildProcess>(
      std::vector<std::string>{KCS_GATEWAY, "attach", "--config", (folder_.path() / "gateway.toml").string(),
                               "--server", cable_->address(), "--record", (folder_.path() / "run.csv").string()});
  begin(part);
}

void Scene::start_server() {
  server_ = std::make_unique<test::KcsdProcess>(std::vector<std::string>{
      KCSD, "--listen", listen_, "--database", "sqlite:" + (folder_.path() / "plans.db").string()});
}

void Scene::connect() {
  const auto channel = grpc::CreateChannel(listen_, grpc::InsecureChannelCredentials());
  machines_ = v1::MachineService::NewStub(channel);
  planning_ = v1::PlanningService::NewStub(channel);
}

void Scene::begin(const Part& part) {
  Call call;
  v1::Plan plan;
  const auto writer = planning_->CreatePlan(&call, &plan);
  for (const v1::CreatePlanRequest& message : part.request) writer->Write(message);
  writer->WritesDone();
  if (const grpc::Status status = writer->Finish(); !status.ok()) throw std::runtime_error(status.error_message());
  v1::RunPlanRequest request;
  request.set_machine("machines/bench");
  request.set_plan(plan.name());
  grpc::Status status;
  for (const auto end = steady_clock::now() + kPatience; steady_clock::now() < end;) {
    Call run_call;
    v1::Run run;
    status = machines_->RunPlan(&run_call, request, &run);
    run_ = run.name();
    if (status.ok()) return;
    std::this_thread::sleep_for(milliseconds(20));
  }
  throw std::runtime_error("the run does not begin: " + status.error_message() + "\n" + gateway_->errors());
}

void Scene::pause_server(bool paused) { server_->process().send_signal(paused ? SIGSTOP : SIGCONT); }

void Scene::restart_server(milliseconds down) {
  server_->process().send_signal(SIGKILL);
  server_->process().wait();
  std::this_thread::sleep_for(down);
  start_server();
  connect();
}

v1::Run Scene::run() {
  grpc::Status status;
  for (const auto end = steady_clock::now() + kPatience; steady_clock::now() < end;) {
    Call call;
    v1::GetRunRequest request;
    request.set_name(run_);
    v1::Run run;
    status = machines_->GetRun(&call, request, &run);
    if (status.ok()) return run;
    std::this_thread::sleep_for(milliseconds(20));
  }
  throw std::runtime_error("nothing is known of the run: " + status.error_message());
}

grpc::Status Scene::hold() {
  Call call;
  v1::HoldRunRequest request;
  request.set_name(run_);
  v1::Run run;
  return machines_->HoldRun(&call, request, &run);
}

grpc::Status Scene::abort() {
  Call call;
  v1::AbortRunRequest request;
  request.set_name(run_);
  v1::Run run;
  return machines_->AbortRun(&call, request, &run);
}

grpc::Status Scene::set_override(double percent) {
  Call call;
  v1::SetFeedOverrideRequest request;
  request.set_name(run_);
  request.set_feed_override_percent(percent);
  v1::Run run;
  return machines_->SetFeedOverride(&call, request, &run);
}

void Scene::wait_for(v1::RunState state) {
  v1::Run seen;
  for (const auto end = steady_clock::now() + kPatience; steady_clock::now() < end;) {
    seen = run();
    if (seen.state() == state) return;
    std::this_thread::sleep_for(milliseconds(5));
  }
  throw std::runtime_error("the run is not " + v1::RunState_Name(state) + ": " + seen.ShortDebugString() + "\n" +
                           gateway_->errors());
}

void Scene::go_on() {
  v1::Run seen;
  for (const auto end = steady_clock::now() + kPatience; steady_clock::now() < end;) {
    seen = run();
    const bool attached = seen.machine_state() != v1::MACHINE_STATE_UNSPECIFIED;
    if (seen.state() >= v1::RUN_STATE_FINISHED) return;
    if (attached && seen.state() == v1::RUN_STATE_RUNNING) return;
    if (attached && seen.state() == v1::RUN_STATE_HELD) {
      Call call;
      v1::ResumeRunRequest request;
      request.set_name(run_);
      v1::Run resumed;
      machines_->ResumeRun(&call, request, &resumed);
    }
    std::this_thread::sleep_for(milliseconds(5));
  }
  throw std::runtime_error("the run does not go on: " + seen.ShortDebugString() + "\n" + gateway_->errors());
}

std::filesystem::path Scene::finish() {
  gateway_->send_signal(SIGTERM);
  if (const int code = gateway_->wait(); code != 0) {
    throw std::runtime_error(fmt::format("the gateway ended with {}:\n{}", code, gateway_->errors()));
  }
  return folder_.path() / "run.csv";
}

}  // namespace kcs::faults
