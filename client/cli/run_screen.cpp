#include "client/cli/run_screen.h"

#include <algorithm>
#include <chrono>
#include <utility>
#include <vector>

#include "client/cli/run_view.h"

namespace kcs::cli {
namespace {

using client::Run;

constexpr std::chrono::milliseconds kRedraw{50};  // as often as a server tells news at most
constexpr std::chrono::seconds kRetry{1};
constexpr double kUsualWindow = 0.25;      // s
constexpr double kStep = 10, kMost = 200;  // override, %

// Of the machine that is on the run: what its buffer is to hold, s.
double window_of(client::Machines& machines, const std::string& run) {
  for (const client::AttachedMachine& machine : machines.list()) {
    if (run.starts_with(machine.name + "/")) return machine.window_s;
  }
  return kUsualWindow;
}

// The server will be there again, or another one instead.
bool passes(const client::Error& error) {
  return error.code() == "UNAVAILABLE" || error.code() == "DEADLINE_EXCEEDED" || error.code() == "CANCELLED";
}

}  // namespace

RunScreen::RunScreen(Terminal& terminal, client::Machines& machines, Run run, bool take_over)
    : terminal_(terminal),
      machines_(machines),
      name_(run.name),
      take_over_(take_over),
      window_s_(window_of(machines, run.name)),
      news_{.run = std::move(run)} {}

Run RunScreen::show() {
  const std::jthread follower([this](const std::stop_token& stop) { follow(stop); });
  while (true) {
    draw();
    const News now = news();
    if (now.fault) std::rethrow_exception(now.fault);
    if (is_over(now.run.state)) return now.run;
    for (const char key : terminal_.read_keys(kRedraw)) {
      answer_.clear();
      const auto order = keys_.press(key);
      if (order == Order::kLeave) return news().run;
      if (order) obey(*order);
    }
  }
}

void RunScreen::follow(const std::stop_token& stop) {
  while (!stop.stop_requested()) {
    try {
      const auto take = [this](const Run& run) {
        const std::lock_guard lock(mutex_);
        news_ = {.run = run};
      };
      machines_.watch(name_, take, stop);
      return;
    } catch (const client::Error& error) {
      std::unique_lock lock(mutex_);
      if (!passes(error)) {
        news_.fault = std::current_exception();
        return;
      }
      news_.trouble = error.what();
      stopped_.wait_for(lock, stop, kRetry, [] { return false; });
    }
  }
}

RunScreen::News RunScreen::news() {
  const std::lock_guard lock(mutex_);
  return news_;
}

void RunScreen::draw() {
  const News now = news();
  std::vector<std::string> lines = run_view(now.run, window_s_);
  if (!now.trouble.empty()) {
    lines.push_back(alarm("What is above is old: " + now.trouble));
  } else if (!answer_.empty()) {
    lines.push_back(alarm("Refused: " + answer_));
  }
  if (!is_over(now.run.state)) lines.push_back(keys_.legend());
  terminal_.draw(lines);
}

void RunScreen::obey(Order order) {
  try {
    Run run = carry_out(order);
    const std::lock_guard lock(mutex_);
    if (!is_over(news_.run.state)) news_.run = std::move(run);  // the end may have been told meanwhile
  } catch (const client::Error& error) {
    answer_ = error.what();
  }
}

Run RunScreen::carry_out(Order order) {
  const double override_percent = news().run.feed_override_percent;
  switch (order) {
    case Order::kHold:
      return machines_.hold(name_);
    case Order::kResume:
      return machines_.resume(name_, take_over_);
    case Order::kSlower:
      return machines_.set_feed_override(name_, std::max(override_percent - kStep, 0.0), take_over_);
    case Order::kFaster:
      return machines_.set_feed_override(name_, std::min(override_percent + kStep, kMost), take_over_);
    case Order::kAbort:
      return machines_.abort(name_);
    case Order::kLeave:
      break;
  }
  return news().run;
}

}  // namespace kcs::cli
