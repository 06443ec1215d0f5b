#include "client/common/planning_options.h"

#include <CLI/CLI.hpp>
#include <initializer_list>
#include <map>

#include "client/common/names.h"
#include "client/sdk/machine_profile.h"

namespace kcs::client {
namespace {

// An option whose value is the name of one of `values`.
template <typename Value>
void add_choice(CLI::App& app, const std::string& name, Value& chosen, std::initializer_list<Value> values,
                const std::string& description) {
  std::map<std::string, Value> choices;
  for (const Value value : values) choices.emplace(name_of(value), value);
  app.add_option_function<std::string>(
         name, [&chosen, choices](const std::string& choice) { chosen = choices.at(choice); }, description)
      ->transform(CLI::IsMember(choices, CLI::ignore_case))
      ->option_text(" ");
}

std::string shipped_names() {
  std::string names;
  for (const ShippedProfile& profile : shipped_profiles()) {
    names += (names.empty() ? "" : ", ") + std::string(profile.name);
  }
  return names;
}

}  // namespace

void add_planning_options(CLI::App& app, std::string& machine, PlanOptions& options, const PlanningDefaults& defaults) {
  app.add_option("--machine", machine,
                 std::string("limits of the machine: a profile's file name, or a\nbuilt-in profile (default: ") +
                     defaults.machine + "):\n" + shipped_names())
      ->option_text("PROFILE.toml");
  app.add_option("--tolerance", options.tolerance_mm, "how far corners may be cut (default: 0.01)")->option_text("MM");
  add_choice(app, "--tolerance-kind", options.tolerance_kind,
             {ToleranceKind::kContourError, ToleranceKind::kCornerDistance},
             "contour: distance from the path (default);\ncorner: distance from the corner point");
  add_choice(app, "--strategy", options.strategy,
             {CornerStrategy::kAuto, CornerStrategy::kInterrupted, CornerStrategy::kUninterrupted,
              CornerStrategy::kBlended, CornerStrategy::kExactStop},
             "how corners are taken: auto (default), interrupted,\nuninterrupted, blended, exact-stop");
  app.add_option("--feed", options.feed_mm_s, "replaces every programmed feed and the rapid")->option_text("MM_PER_S");
  app.add_option("--start", options.start_mm, "where the program starts (default: " + defaults.start + ")")
      ->delimiter(',')
      ->option_text("X,Y,Z");
}

}  // namespace kcs::client
