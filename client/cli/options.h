// The command line of kcsctl.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "client/cli/setpoint_writer.h"
#include "client/common/command_line.h"
#include "client/common/planning_options.h"
#include "client/sdk/connection.h"
#include "client/sdk/plan.h"
#include "client/sdk/setpoint_stream.h"

namespace kcs::cli {

enum class Command {
  kPlan,
  kStream,
  kLive,
  kCorners,
  kPlot,
  kMachines,
  kRun,
  kHold,
  kResume,
  kAbort,
  kOverride,
  kWatch,
  kHealth
};

// Of the commands that are about machines and their runs. Machines may be named without their "machines/".
struct RunOptions {
  std::string machine;                          // run: where
  std::string plan;                             // run: of the server; empty: the program's
  std::string profile;                          // run: to plan with; empty: the machine's own limits
  std::string run;                              // hold, resume, abort, override, watch; a machine: what it is on
  std::optional<double> feed_override_percent;  // run, override
  bool watch = false;                           // run
  bool take_over = false;                       // resume, override, watch
};

struct Options {
  Command command = Command::kPlan;
  std::string file;  // the G-code program; "-": standard input
  std::string machine = client::kDefaultMachine;
  client::PlanOptions plan;   // all but the machine
  double period_s = 0.001;    // between two setpoints; of use to stream, live and plot alone
  client::Connection server;  // without an address: plan inside this process

  RunOptions run;

  bool json = false;                      // all but stream and plot
  std::string output;                     // stream, live (empty: none), plot; "-": standard output
  std::vector<client::Channel> channels;  // stream, live
  std::optional<SetpointFormat> format;   // stream, live; none: by the end of the output's name
  double from_s = 0;                      // plot: the window of time
  std::optional<double> to_s;             // plot; none: the end

  std::string http = "127.0.0.1:50552";  // health: where the server speaks HTTP
};

// The format of the setpoints that are written.
inline SetpointFormat format_of(const Options& options) { return options.format.value_or(format_of(options.output)); }

// Reads the command line into `options`. Returns a message if there is nothing to run.
std::optional<client::Message> parse_command_line(int argc, const char* const* argv, Options& options);

}  // namespace kcs::cli
