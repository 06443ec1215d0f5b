// The planner that a command talks to, and the plan of its program.
#pragma once

#include "client/cli/options.h"
#include "client/cli/planner_access.h"
#include "client/sdk/planner.h"

namespace kcs::cli {

// Plans the program in this file; "-": from standard input. Throws client::Error, or client::FileError if the program
// cannot be read.
client::Plan plan_file(client::Planner& planner, const std::string& file, const client::PlanOptions& options);

// Plans the program of the command line.
class PlanningSession {
 public:
  // Throws client::ProfileError, client::Error, or client::FileError if the program cannot be read.
  explicit PlanningSession(const Options& options);

  client::Planner& planner() { return access_.planner(); }
  const client::Plan& plan() const { return plan_; }

 private:
  PlannerAccess access_;
  client::Plan plan_;
};

}  // namespace kcs::cli
