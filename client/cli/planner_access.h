// The planner that a command talks to.
#pragma once

#include <memory>

#include "client/cli/options.h"
#include "client/sdk/planner.h"

namespace kcs::service {
class Server;
}

namespace kcs::cli {

// A planner on the server that the command line names, or on one inside this process, which this object owns: streams
// of the planner must end before it.
class PlannerAccess {
 public:
  explicit PlannerAccess(const Options& options);
  ~PlannerAccess();

  client::Planner& planner() { return *planner_; }

 private:
  std::unique_ptr<service::Server> server_;  // none if the command line names one
  std::unique_ptr<client::Planner> planner_;
};

// What the command line says of how to plan, with the machine. Throws client::ProfileError.
client::PlanOptions plan_options(const Options& options);

}  // namespace kcs::cli
