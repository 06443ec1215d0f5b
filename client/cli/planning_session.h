// The planner that a command talks to, and the plan of its program.
#pragma once

#include <memory>

#include "client/cli/options.h"
#include "client/sdk/planner.h"

namespace kcs::service {
class Server;
}

namespace kcs::cli {

// Plans the program of the command line: on the server that it names, or on one inside this process.
// The session owns that server; streams of the planner must end before it.
class PlanningSession {
 public:
  // Throws client::ProfileError, client::Error, or client::FileError if the program cannot be read.
  explicit PlanningSession(const Options& options);
  ~PlanningSession();

  client::Planner& planner() { return *planner_; }
  const client::Plan& plan() const { return plan_; }

 private:
  std::unique_ptr<service::Server> server_;  // none if the command line names one
  std::unique_ptr<client::Planner> planner_;
  client::Plan plan_;
};

}  // namespace kcs::cli
