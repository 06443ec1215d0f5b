#include "client/cli/planning_session.h"

#include <cstdint>
#include <iostream>
#include <limits>

#include "client/common/program_file.h"
#include "client/sdk/machine_profile.h"
#include "server/service/server.h"

namespace kcs::cli {
namespace {

// The caps protect a server that many share; here the user's own memory is the only one.
std::unique_ptr<service::Server> make_local_server() {
  constexpr std::uint64_t kNoCap = std::numeric_limits<std::int64_t>::max();
  service::ServerOptions options;
  options.listen = "";
  options.planning_threads = 1;
  options.caps.points_per_plan = kNoCap;
  options.caps.gcode_bytes = kNoCap;
  options.caps.stored_bytes = kNoCap;
  return std::make_unique<service::Server>(options);
}

client::Plan plan_file(client::Planner& planner, const std::string& file, const client::PlanOptions& options) {
  if (file == "-") return planner.plan_gcode(std::cin, options);
  std::ifstream program = client::open_program(file);
  return planner.plan_gcode(program, options);
}

}  // namespace

PlanningSession::PlanningSession(const Options& options) {
  client::PlanOptions plan_options = options.plan;
  plan_options.machine = client::find_machine(options.machine);
  if (options.server) {
    planner_ = std::make_unique<client::Planner>(*options.server);
  } else {
    server_ = make_local_server();
    planner_ = std::make_unique<client::Planner>(server_->in_process_channel());
  }
  plan_ = plan_file(*planner_, options.file, plan_options);
}

PlanningSession::~PlanningSession() = default;

}  // namespace kcs::cli
