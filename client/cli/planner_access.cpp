#include "client/cli/planner_access.h"

#include <cstdint>
#include <limits>

#include "client/sdk/machine_profile.h"
#include "client/sdk/server_link.h"
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
  options.caps.gcode_bytes = std::uint64_t{1} << 30;  // a program goes into the store in one piece
  options.store.database = "memory";
  options.caps.cached_bytes = kNoCap;
  return std::make_unique<service::Server>(options);
}

}  // namespace

PlannerAccess::PlannerAccess(const Options& options) {
  if (!options.server.address.empty()) {
    planner_ = std::make_unique<client::Planner>(options.server);
  } else {
    server_ = make_local_server();
    planner_ = std::make_unique<client::Planner>(client::ServerLink(server_->in_process_channel()));
  }
}

PlannerAccess::~PlannerAccess() = default;

client::PlanOptions plan_options(const Options& options) {
  client::PlanOptions plan = options.plan;
  plan.machine = client::find_machine(options.machine);
  return plan;
}

}  // namespace kcs::cli
