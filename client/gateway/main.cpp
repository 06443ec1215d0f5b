// kcs-gateway: plays a plan at the drives' period into simulated drives, or stays beside a machine (attach).
#include <algorithm>
#include <cstdint>
#include <iostream>
#include <utility>

#include "client/common/failure_report.h"
#include "client/common/file_error.h"
#include "client/common/program_file.h"
#include "client/common/progress_bar.h"
#include "client/gateway/command_line.h"
#include "client/gateway/machine/attach.h"
#include "client/gateway/machine/settings.h"
#include "client/gateway/plan_source.h"
#include "client/gateway/playback.h"
#include "client/gateway/report.h"
#include "client/sdk/machine_profile.h"

namespace kcs::gateway {
namespace {

PlanSource make_source(const CommandLine& options) {
  if (!options.plan.empty()) return {options.server, options.plan};
  Program program = {.file = options.file, .options = options.planning};
  program.options.machine = client::find_machine(options.machine);
  return {options.server, std::move(program)};
}

PlaybackResult play_with_progress(PlanSource source, const client::Plan& plan, PlaybackOptions options) {
  client::ProgressBar bar("playing");
  const double seconds = std::min(options.seconds.value_or(plan.summary.cycle_time_s), plan.summary.cycle_time_s);
  const auto total = static_cast<std::uint64_t>(seconds / options.period_s);
  options.on_progress = [&bar, total](std::uint64_t ticks) { bar.update(ticks, total); };
  return play(std::move(source), plan, options);
}

Settings settings_of(const CommandLine& options) {
  Settings settings = read_settings(*options.attach);
  const client::Connection& server = options.attach_server;
  const std::filesystem::path token = server.token_file.empty() ? settings.server.token_file : server.token_file;
  if (!server.address.empty()) settings.server = server;
  settings.server.token_file = token;
  if (settings.server.address.empty()) {
    throw client::SettingsError(options.attach->string() + ": server.address is missing; or give --server HOST:PORT");
  }
  return settings;
}

client::ExitCode run(const CommandLine& options) {
  if (options.attach) return attach(settings_of(options), options.attach_record);
  if (options.playback.record) client::require_not_the_program(options.file, *options.playback.record);
  PlanSource source = make_source(options);
  const client::Plan plan = source.obtain();
  const PlaybackResult result = play_with_progress(std::move(source), plan, options.playback);
  std::cout << (options.json ? report_json(plan, options.playback, result)
                             : report_table(plan, options.playback, result))
            << std::flush;
  if (!std::cout) throw client::FileError("standard output cannot be written; is the disk full?");
  return result.state == PlayState::kFinished ? client::kDone : client::kStarved;
}

}  // namespace
}  // namespace kcs::gateway

int main(int argc, char** argv) {
  using namespace kcs;
  gateway::CommandLine options;
  if (const auto message = gateway::parse_command_line(argc, argv, options)) return client::print(*message);
  return client::run_and_report("kcs-gateway", options.file, [&options] { return gateway::run(options); });
}
