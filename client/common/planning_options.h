// The options that say how a program is planned, the same in every command.
#pragma once

#include <string>

#include "client/sdk/plan.h"

namespace CLI {
class App;
}

namespace kcs::client {

// The profile that is used unless --machine names another one.
inline constexpr const char* kDefaultMachine = "router";

// What holds where an option is not given, for the help text.
struct PlanningDefaults {
  std::string machine = kDefaultMachine;
  std::string start = "0,0,0";
};

// Adds --machine, --tolerance, --tolerance-kind, --strategy, --feed and --start. What they say goes to `machine` (for
// find_machine) and `options` (all but the machine), which must live until `app` has read the command line.
void add_planning_options(CLI::App& app, std::string& machine, PlanOptions& options,
                          const PlanningDefaults& defaults = {});

}  // namespace kcs::client
