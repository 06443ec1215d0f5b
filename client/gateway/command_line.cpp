#include "client/gateway/command_line.h"

#include <CLI/CLI.hpp>
#include <map>
#include <sstream>

namespace kcs::gateway {
namespace {

using client::CornerStrategy;
using client::ToleranceKind;

constexpr const char* kFooter =
    "Exit codes: 0 played as asked, 1 refused, 2 wrong command line, 3 no server\n"
    "answers, 4 a file cannot be read or written, 5 an error inside kcs, 6 starved:\n"
    "no setpoint was there when one was due.";

const std::map<std::string, ToleranceKind> kToleranceKinds = {{"contour", ToleranceKind::kContourError},
                                                              {"corner", ToleranceKind::kCornerDistance}};
const std::map<std::string, CornerStrategy> kStrategies = {{"auto", CornerStrategy::kAuto},
                                                           {"interrupted", CornerStrategy::kInterrupted},
                                                           {"uninterrupted", CornerStrategy::kUninterrupted},
                                                           {"exact-stop", CornerStrategy::kExactStop}};

void add_source(CLI::App& app, CommandLine& options) {
  CLI::Option* file = app.add_option("FILE", options.file, "G-code program to have planned and to play");
  file->option_text(" ");
  app.add_option("--plan", options.plan, "plan to play that the server keeps, instead of FILE")
      ->excludes(file)
      ->option_text("plans/NAME");
  app.add_option("--server", options.server, "the kcsd to take the plan from")->required()->option_text("HOST:PORT");
}

// As kcsctl has them.
void add_planning(CLI::App& app, CommandLine& options) {
  app.add_option("--machine", options.machine,
                 "limits of the machine, for FILE: a profile's file\n"
                 "name or a built-in profile (default: router)")
      ->option_text("PROFILE.toml");
  app.add_option("--tolerance", options.planning.tolerance_mm, "how far corners may be cut (default: 0.01)")
      ->option_text("MM");
  app.add_option("--tolerance-kind", options.planning.tolerance_kind,
                 "contour: distance from the path (default);\ncorner: distance from the corner point")
      ->transform(CLI::CheckedTransformer(kToleranceKinds, CLI::ignore_case))
      ->option_text(" ");
  app.add_option("--strategy", options.planning.strategy,
                 "how corners are taken: auto (default), interrupted,\nuninterrupted, exact-stop")
      ->transform(CLI::CheckedTransformer(kStrategies, CLI::ignore_case))
      ->option_text(" ");
  app.add_option("--feed", options.planning.feed_mm_s, "replaces every programmed feed and the rapid")
      ->option_text("MM_PER_S");
  app.add_option("--start", options.planning.start_mm, "where the program starts (default: 0,0,0)")
      ->delimiter(',')
      ->option_text("X,Y,Z");
}

void add_playing(CLI::App& app, CommandLine& options) {
  PlaybackOptions& playback = options.playback;
  app.add_option("--period", playback.period_s, "the drives' period (default: 0.001)")
      ->check(CLI::Range(1e-5, 10.0))
      ->option_text("S");
  app.add_option("--buffer", playback.buffer_s, "motion held ready against trouble on the network\n(default: 1)")
      ->check(CLI::Range(1e-3, 3600.0))
      ->option_text("S");
  app.add_option("--seconds", playback.seconds, "play only so much of the plan; the simulation ends\nin mid-motion")
      ->check(CLI::PositiveNumber)
      ->option_text("S");
  app.add_flag("--fast", playback.simulated_time,
               "play in simulated time, as fast as it computes,\n"
               "instead of by the clock");
  app.add_option("--record", playback.record, "write commanded and actual positions of every tick")
      ->option_text("FILE.csv");
  app.add_flag("--json", options.json, "print one JSON object instead of the table");
}

}  // namespace

std::optional<Message> parse_command_line(int argc, const char* const* argv, CommandLine& options) {
  CLI::App app("Plays a plan at the drives' period into simulated drives, and says how well they\nfollowed.",
               "kcs-gateway");
  app.footer(kFooter);
  app.get_formatter()->column_width(26);
  add_source(app, options);
  add_planning(app, options);
  add_playing(app, options);
  app.callback([&options] {
    if (options.file.empty() && options.plan.empty()) throw CLI::RequiredError("Either FILE or --plan");
  });
  try {
    app.parse(argc, argv);
    return std::nullopt;
  } catch (const CLI::ParseError& error) {
    std::ostringstream out;
    std::ostringstream problems;
    const bool is_error = app.exit(error, out, problems) != 0;
    return Message{is_error ? "kcs-gateway: " + problems.str() : out.str(), is_error};
  }
}

}  // namespace kcs::gateway
