// kcs-gateway: plays a plan at the drives' period into simulated drives.
#include <algorithm>
#include <cstdint>
#include <exception>
#include <iostream>
#include <string>
#include <utility>

#include "client/cli/progress_bar.h"
#include "client/gateway/command_line.h"
#include "client/gateway/failure.h"
#include "client/gateway/plan_source.h"
#include "client/gateway/playback.h"
#include "client/gateway/report.h"
#include "client/sdk/machine_profile.h"

namespace kcs::gateway {
namespace {

client::Machine read_machine(const std::string& name) {
  for (const client::ShippedProfile& profile : client::shipped_profiles()) {
    if (profile.name == name) return client::parse_machine_profile(profile.text, name);
  }
  return client::read_machine_profile(name);
}

PlanSource make_source(const CommandLine& options) {
  if (!options.plan.empty()) return {options.server, options.plan};
  Program program = {.file = options.file, .options = options.planning};
  program.options.machine = read_machine(options.machine);
  return {options.server, std::move(program)};
}

PlaybackResult play_with_progress(PlanSource source, const client::Plan& plan, PlaybackOptions options) {
  cli::ProgressBar bar("playing");
  const double seconds = std::min(options.seconds.value_or(plan.summary.cycle_time_s), plan.summary.cycle_time_s);
  const auto total = static_cast<std::uint64_t>(seconds / options.period_s);
  options.on_progress = [&bar, total](std::uint64_t ticks) { bar.update(ticks, total); };
  return play(std::move(source), plan, options);
}

ExitCode run(const CommandLine& options) {
  PlanSource source = make_source(options);
  const client::Plan plan = source.obtain();
  const PlaybackResult result = play_with_progress(std::move(source), plan, options.playback);
  std::cout << (options.json ? report_json(plan, options.playback, result)
                             : report_table(plan, options.playback, result));
  return result.state == PlayState::kFinished ? kDone : kStarved;
}

}  // namespace
}  // namespace kcs::gateway

int main(int argc, char** argv) {
  using namespace kcs::gateway;
  CommandLine options;
  if (const auto message = parse_command_line(argc, argv, options)) {
    (message->is_error ? std::cerr : std::cout) << message->text;
    return message->is_error ? kUsage : kDone;
  }
  try {
    return run(options);
  } catch (...) {
    const Failure failure = describe_failure(std::current_exception());
    std::cerr << failure.text;
    return failure.exit_code;
  }
}
