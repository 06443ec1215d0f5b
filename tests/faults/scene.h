// A service, a gateway with its drives, a line between them, and one run after the other.
#pragma once

#include <grpcpp/grpcpp.h>
#include <kcs/v1/machine.grpc.pb.h>
#include <kcs/v1/planning.grpc.pb.h>

#include <chrono>
#include <functional>
#include <memory>
#include <string>

#include "tests/cable/cable.h"
#include "tests/faults/drives.h"
#include "tests/faults/judge.h"
#include "tests/faults/program.h"
#include "tests/faults/scrambler.h"
#include "tests/faults/service.h"
#include "tests/system/child_process.h"

namespace kcs::faults {

class Scene {
 public:
  // Everything up, nothing run yet; with a scrambler before the server if there is to be one. Throws std::runtime_error
  // if something does not work, as all of this does.
  Scene(std::unique_ptr<Drives> drives, const ProgramCursor& cursor, bool scrambles = false,
        std::unique_ptr<Service> service = one_server());

  const Drives& drives() const { return *drives_; }
  test::Cable& cable() { return *cable_; }
  Scrambler& scrambler() { return *scrambler_; }
  Service& service() { return *service_; }
  // kill -9, and a new one.
  void restart_gateway(std::chrono::milliseconds down);

  // Waits until the machine moves: resumes its run as often as it is held, begins the next one when it is over.
  void go_on();
  // Waits until the run is at the end of its path; resumes it as often as it is held.
  void run_to_end();
  bool is_running() { return run().state() == v1::RUN_STATE_RUNNING; }
  void hold();
  void abort();
  void set_override(double percent);
  void wait_for(v1::RunState state);

  // Ends the gateway. The run must be over.
  void finish();
  // Those that were begun; after finish().
  const Runs& runs() const { return runs_; }
  // How often the gateway's player had no batch when one was due.
  std::uint64_t starvations() { return run().starvations(); }
  // What the gateway has logged; of the last one.
  std::string log() const { return gateway_->errors(); }

 private:
  void start_gateway();
  void begin(const planning::Toolpath& path);
  std::string create_plan(const planning::Toolpath& path);
  v1::Run run();
  motion::Vector machine_position();
  void note_end(const v1::Run& run);
  void resume();
  void wait_until(const std::function<bool(const v1::Run&)>& is_so, const char* what, std::chrono::seconds patience,
                  std::chrono::milliseconds look_again = std::chrono::milliseconds(5));

  std::unique_ptr<Drives> drives_;
  ProgramCursor cursor_;
  std::unique_ptr<Service> service_;
  std::unique_ptr<Scrambler> scrambler_;
  std::unique_ptr<test::Cable> cable_;
  std::unique_ptr<test::ChildProcess> gateway_;
  std::unique_ptr<v1::MachineService::Stub> machines_;
  std::unique_ptr<v1::PlanningService::Stub> planning_;
  Runs runs_;
  std::string run_;  // empty: none yet
};

}  // namespace kcs::faults
