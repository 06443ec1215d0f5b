#include "client/cli/commands.h"

#include <fmt/core.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iostream>

#include "client/cli/corners_table.h"
#include "client/cli/gnuplot.h"
#include "client/cli/health.h"
#include "client/cli/json.h"
#include "client/cli/live.h"
#include "client/cli/machine_commands.h"
#include "client/cli/numbers.h"
#include "client/cli/output.h"
#include "client/cli/pending_file.h"
#include "client/cli/plan_table.h"
#include "client/cli/planning_session.h"
#include "client/cli/plot_script.h"
#include "client/cli/setpoint_writer.h"
#include "client/common/file_error.h"
#include "client/common/program_file.h"
#include "client/common/progress_bar.h"

namespace kcs::cli {
namespace {

std::string program_name(const Options& options) { return options.file == "-" ? "standard input" : options.file; }

void plan(const Options& options) {
  PlanningSession session(options);
  print(options.json
            ? plan_json(session.plan())
            : plan_table(program_name(options), session.plan(), session.planner().corners(session.plan().name)));
}

void corners(const Options& options) {
  PlanningSession session(options);
  const std::vector<client::Corner> corners = session.planner().corners(session.plan().name);
  print(options.json ? corners_json(corners) : corners_table(corners));
}

void write_setpoints(const Options& options, PlanningSession& session, std::ostream& out) {
  const client::StreamOptions stream_options{.period_s = options.period_s, .channels = options.channels};
  auto stream = session.planner().stream_setpoints(session.plan().name, stream_options);
  client::ProgressBar bar("setpoints");
  const auto writer =
      make_writer(format_of(options), {session.plan().options.machine.axes, options.channels, options.period_s}, out);
  for (client::SetpointBatch batch; stream.next(batch);) {
    writer->add(batch);
    bar.update(batch.first_index + batch.size(), batch.setpoint_count);
  }
  writer->finish();
}

// Has `write` write to the file of that name, which appears when it is complete; "-": to standard output.
void write_output(const Options& options, const std::function<void(std::ostream&)>& write) {
  if (options.output == "-") return write(std::cout);
  client::require_not_the_program(options.file, options.output);
  PendingFile file(options.output);
  std::ofstream out(file.path(), std::ios::binary);
  if (!out)
    throw client::FileError(fmt::format("{}: cannot be written; check the folder and its permissions", options.output));
  write(out);
  out.close();
  file.commit();
}

void stream(const Options& options) {
  write_output(options, [&options](std::ostream& out) {
    PlanningSession session(options);
    write_setpoints(options, session, out);
  });
}

void live(const Options& options) {
  client::Plan plan;
  if (options.output.empty()) {
    plan = plan_live(options, nullptr);
  } else {
    write_output(options, [&](std::ostream& out) { plan = plan_live(options, &out); });
  }
  if (options.output == "-") return;
  print(options.json ? plan_json(plan) : plan_table(program_name(options), plan, {}));
}

PictureFormat picture_format(const std::string& name) {
  if (name.ends_with(".svg")) return PictureFormat::kSvg;
  if (name.ends_with(".png")) return PictureFormat::kPng;
  throw client::FileError(fmt::format("{}: no such kind of picture; end the name in .svg or .png", name));
}

void plot(const Options& options) {
  const PictureFormat format = picture_format(options.output);
  client::require_not_the_program(options.file, options.output);
  PendingFile file(options.output);
  if (!std::ofstream(file.path()))  // or gnuplot would find out, in its own words
    throw client::FileError(fmt::format("{}: cannot be written; check the folder and its permissions", options.output));
  PlanningSession session(options);
  const double cycle_time = session.plan().summary.cycle_time_s;
  const double to = std::min(options.to_s.value_or(cycle_time), cycle_time);
  if (options.from_s < 0 || options.from_s >= to) {
    throw client::Error("INVALID_ARGUMENT",
                        fmt::format("the window from {} s to {} s is empty: --from must be at least 0 "
                                    "and less than --to and the cycle time, {:.3f} s",
                                    options.from_s, options.to_s.value_or(cycle_time), cycle_time));
  }
  const PlotData data = gather_plot_data(session.planner(), session.plan(), options.from_s, to, options.period_s);
  const std::string title =
      fmt::format("{}: {} ({:.3f} s) on {}", std::filesystem::path(program_name(options)).filename().string(),
                  clock_time(cycle_time), cycle_time, session.plan().options.machine.name);
  run_gnuplot(plot_script(data, session.plan(), title, file.path().string(), format));
  file.commit();
}

}  // namespace

void run_command(const Options& options) {
  switch (options.command) {
    case Command::kPlan:
      return plan(options);
    case Command::kStream:
      return stream(options);
    case Command::kLive:
      return live(options);
    case Command::kCorners:
      return corners(options);
    case Command::kPlot:
      return plot(options);
    case Command::kMachines:
      return list_machines(options);
    case Command::kRun:
      return run_plan(options);
    case Command::kHold:
    case Command::kResume:
    case Command::kAbort:
    case Command::kOverride:
      return operate_run(options);
    case Command::kWatch:
      return watch_run(options);
    case Command::kHealth:
      return check_health(options.http);
  }
}

}  // namespace kcs::cli
