#include "client/cli/planning_session.h"

#include <iostream>

#include "client/common/program_file.h"

namespace kcs::cli {

client::Plan plan_file(client::Planner& planner, const std::string& file, const client::PlanOptions& options) {
  if (file == "-") return planner.plan_gcode(std::cin, options);
  std::ifstream program = client::open_program(file);
  return planner.plan_gcode(program, options);
}

PlanningSession::PlanningSession(const Options& options)
    : access_(options), plan_(plan_file(access_.planner(), options.file, plan_options(options))) {}

}  // namespace kcs::cli
