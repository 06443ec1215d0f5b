// A kcsd, a gateway with simulated drives, a line between them, and one run.
#pragma once

#include <grpcpp/grpcpp.h>
#include <kcs/v1/machine.grpc.pb.h>
#include <kcs/v1/planning.grpc.pb.h>

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "server/planning/plan.h"
#include "tests/cable/cable.h"
#include "tests/files/temporary_folder.h"
#include "tests/system/kcsd_process.h"

namespace kcs::faults {

// What is run, and the same plan made here, to judge by.
struct Part {
  std::string name;
  std::vector<v1::CreatePlanRequest> request;
  motion::AxisLimits limits;
  planning::Plan plan;
};

// Many sharp corners, and a program of dense curves.
Part sharp_part();
Part dense_part();

class Scene {
 public:
  // Everything up, the run begun. Throws std::runtime_error if something does not work.
  explicit Scene(const Part& part);

  test::Cable& cable() { return *cable_; }
  test::ChildProcess& gateway() { return *gateway_; }
  void pause_server(bool paused);
  // kill -9, and a new one on the same port and database.
  void restart_server(std::chrono::milliseconds down);

  v1::Run run();
  grpc::Status hold();
  grpc::Status abort();
  grpc::Status set_override(double percent);
  // Until it is so; throws std::runtime_error with the run if it does not become so.
  void wait_for(v1::RunState state);
  bool is_over() { return run().state() >= v1::RUN_STATE_FINISHED; }
  // Waits until it moves, or is over; resumes it as often as it is held.
  void go_on();

  // Ends the gateway; every command that it gave.
  std::filesystem::path finish();

 private:
  void start_server();
  void begin(const Part& part);
  void connect();

  test::TemporaryFolder folder_;
  std::string listen_;
  std::unique_ptr<test::KcsdProcess> server_;
  std::unique_ptr<test::Cable> cable_;
  std::unique_ptr<test::ChildProcess> gateway_;
  std::unique_ptr<v1::MachineService::Stub> machines_;
  std::unique_ptr<v1::PlanningService::Stub> planning_;
  std::string run_;
};

}  // namespace kcs::faults
