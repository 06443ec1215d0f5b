#include "client/cli/run_view.h"

#include <fmt/core.h>

#include <algorithm>
#include <string_view>

#include "client/cli/numbers.h"
#include "client/common/names.h"
#include "client/common/progress_bar.h"

namespace kcs::cli {
namespace {

using client::MachineState;
using client::Run;
using client::RunState;

constexpr std::size_t kBar = 40;  // columns
constexpr double kMsPerS = 1000;
constexpr double kSPerMin = 60;

constexpr std::string_view kGreen = "\x1b[1;32m";
constexpr std::string_view kYellow = "\x1b[1;33m";
constexpr std::string_view kRed = "\x1b[1;31m";
constexpr std::string_view kPlain = "\x1b[0m";

std::string_view colour_of(RunState state) {
  switch (state) {
    case RunState::kRunning:
    case RunState::kFinished:
      return kGreen;
    case RunState::kWaiting:
    case RunState::kStopping:
    case RunState::kHeld:
      return kYellow;
    case RunState::kAborted:
    case RunState::kFailed:
      return kRed;
  }
  return kPlain;
}

// What the state means for the operator.
std::string_view meaning_of(const Run& run) {
  switch (run.state) {
    case RunState::kWaiting:
      return run.machine_state == MachineState::kUnknown ? "the machine is not attached" : "for the machine";
    case RunState::kRunning:
      return run.feed_override_percent == 0 ? "the override is 0 %: at rest, or coming to it" : "";
    case RunState::kStopping:
      return "comes to rest on the path";
    case RunState::kHeld:
      return "at rest on the path";
    case RunState::kFinished:
      return "the end of the path is reached";
    case RunState::kAborted:
    case RunState::kFailed:
      return "";
  }
  return "";
}

double share_done(const Run& run) {
  return run.cycle_time_s > 0 ? std::clamp(run.plan_time_s / run.cycle_time_s, 0.0, 1.0) : 0;
}

// In whole percent, 100 at the end alone.
int percent_done(const Run& run) {
  constexpr int kAll = 100;
  return static_cast<int>(kAll * share_done(run));
}

// While it does not move: what would be left if it did.
double time_left(const Run& run) {
  constexpr double kPercent = 100;
  if (is_over(run.state) || run.time_left_s > 0 || run.feed_override_percent <= 0) return run.time_left_s;
  return (run.cycle_time_s - run.plan_time_s) * kPercent / run.feed_override_percent;
}

std::string time_left_text(const Run& run) {
  const double left = time_left(run);
  return left > 0 ? clock_time(left) + " left" : "";
}

std::string position_text(const Run& run, std::size_t width) {
  std::string text;
  for (std::size_t axis = 0; axis < std::min(run.position_mm.size(), client::kAxisNames.size()); ++axis) {
    text += fmt::format("{}{}{:>{}}", text.empty() ? "" : " ", client::kAxisNames[axis],
                        decimal(run.position_mm[axis], 3), width);
  }
  return text.empty() ? "not known" : text + " mm";
}

std::string row(std::string_view label, const std::string& value) { return fmt::format("{:<10}{}", label, value); }

}  // namespace

std::vector<std::string> run_view(const Run& run, double window_s) {
  const std::string state =
      fmt::format("{}{}{}  {}", colour_of(run.state), name_of(run.state), kPlain, meaning_of(run));
  std::vector<std::string> lines = {
      row("Run", run.name),
      row("State", state),
      row("Position", position_text(run, 11)),
      row("Feed", fmt::format("{:>10} mm/min {:>10} mm/s   override {:>3.0f} %", decimal(kSPerMin * run.feed_mm_s, 0),
                              decimal(run.feed_mm_s, 2), run.feed_override_percent)),
      row("Buffer", fmt::format("{} {:>4.0f} ms", client::bar(window_s > 0 ? run.buffered_s / window_s : 0, kBar),
                                kMsPerS * run.buffered_s)),
      row("Program",
          fmt::format("{} {:>4} %   {}", client::bar(share_done(run), kBar), percent_done(run), time_left_text(run)))};
  if (!run.reason.empty()) lines.push_back(row("Reason", alarm(run.reason)));
  return lines;
}

std::string alarm(const std::string& text) { return fmt::format("{}{}{}", kRed, text, kPlain); }

std::string run_line(const Run& run) {
  std::string line = fmt::format("{}  {}  {:.1f} %  {}  {:.2f} mm/s  override {:.0f} %  buffer {:.0f} ms", run.name,
                                 name_of(run.state), 100 * share_done(run), position_text(run, 0), run.feed_mm_s,
                                 run.feed_override_percent, kMsPerS * run.buffered_s);
  if (const std::string left = time_left_text(run); !left.empty()) line += "  " + left;
  return run.reason.empty() ? line : line + "  " + run.reason;
}

}  // namespace kcs::cli
