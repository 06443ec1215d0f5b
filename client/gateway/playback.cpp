#include "client/gateway/playback.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <optional>
#include <thread>
#include <utility>

#include "client/gateway/observer.h"
#include "client/gateway/periodic_timer.h"
#include "client/gateway/real_time.h"
#include "client/gateway/setpoint_feed.h"
#include "client/gateway/simulated_table.h"
#include "client/gateway/trace.h"

namespace kcs::gateway {
namespace {

// Setpoints. In simulated time nothing but throughput counts.
constexpr std::size_t kSmallestBuffer = 8;
constexpr std::size_t kSimulatedBuffer = 16'384;
constexpr std::chrono::microseconds kPollInterval{200};

void wait_a_little() { std::this_thread::sleep_for(kPollInterval); }

Vector to_vector(const std::vector<double>& numbers) {
  Vector vector = Vector::Zero();
  std::copy_n(numbers.begin(), std::min<std::size_t>(numbers.size(), 3), vector.begin());
  return vector;
}

FeedOptions feed_options(const client::Plan& plan, const PlaybackOptions& options) {
  const auto setpoints = [&options](double seconds) {
    return static_cast<std::uint64_t>(std::max(1.0, std::round(seconds / options.period_s)));
  };
  return {
      .axes = plan.options.machine.axes,
      .period_s = options.period_s,
      .last_index = options.seconds ? std::optional(setpoints(*options.seconds)) : std::nullopt,
      .capacity = std::max(setpoints(options.buffer_s), options.simulated_time ? kSimulatedBuffer : kSmallestBuffer)};
}

// The machine's side of a run: what happens at each tick.
class Run {
 public:
  Run(SetpointFeed& feed, Trace& trace, const client::Plan& plan, double period)
      : feed_(feed),
        trace_(trace),
        player_(feed.queue(), to_vector(plan.summary.start_mm)),
        table_(plan.options.machine.axes, to_vector(plan.summary.start_mm)),
        period_(period) {}

  // Plays one setpoint; false when there is none left to play. Neither allocates nor waits.
  bool tick() {
    const bool filling = !feed_.ended();
    const PlayState state = player_.tick();
    if (state == PlayState::kStarved) return false;
    const Vector actual = table_.follow(player_.position_mm(), period_);
    const Tick tick = {player_.position_mm(), actual, feed_.queue().size(), filling, monotonic_s()};
    if (!trace_.put(tick)) ++unmeasured_ticks_;
    return state == PlayState::kPlaying;
  }

  PlayState state() const { return player_.state(); }
  std::uint64_t unmeasured_ticks() const { return unmeasured_ticks_; }

 private:
  SetpointFeed& feed_;
  Trace& trace_;
  Player player_;
  SimulatedTable table_;
  double period_;  // s
  std::uint64_t unmeasured_ticks_ = 0;
};

// Waits until `setpoints` are buffered, or as many as there will ever be, or none has come for `patience_s`.
void wait_for_setpoints(SetpointFeed& feed, std::size_t setpoints, double patience_s) {
  using Clock = std::chrono::steady_clock;
  const std::chrono::duration<double> patience(patience_s);
  auto last_arrival = Clock::now();
  for (std::size_t before = feed.queue().size(); !feed.ended() && before < setpoints;) {
    wait_a_little();
    const std::size_t now = feed.queue().size();
    if (std::exchange(before, now) != now) last_arrival = Clock::now();
    if (Clock::now() - last_arrival > patience) return;
  }
}

ClockFigures run_by_the_clock(Run& run, double period) {
  ClockFigures figures;
  const RealTime real_time;
  figures.fifo = real_time.fifo();
  figures.memory_locked = real_time.memory_locked();
  PeriodicTimer timer(period);
  do {
    const std::int64_t late = timer.wait();
    figures.lateness.record(late);
    if (static_cast<double>(late) > period * 1e9) ++figures.late_ticks;
    figures.missed_periods = timer.missed();
  } while (run.tick());
  return figures;
}

// Time stands still while setpoints are on their way or the measurement is behind.
void run_in_simulated_time(Run& run, SetpointFeed& feed, const Trace& trace, double patience_s) {
  do {
    wait_for_setpoints(feed, 1, patience_s);
    while (trace.size() == trace.capacity()) wait_a_little();
  } while (run.tick());
}

}  // namespace

PlaybackResult play(PlanSource source, const client::Plan& plan, const PlaybackOptions& options) {
  Observer observer({.axes = plan.options.machine.axes,
                     .period_s = options.period_s,
                     .record = options.record,
                     .on_progress = options.on_progress});
  SetpointFeed feed(std::move(source), feed_options(plan, options));
  Run run(feed, observer.trace(), plan, options.period_s);

  PlaybackResult result;
  wait_for_setpoints(feed, feed.queue().capacity() * 3 / 4,  // the feed leaves room for less than a quarter
                     options.patience_s);
  if (options.simulated_time) {
    run_in_simulated_time(run, feed, observer.trace(), options.patience_s);
  } else {
    result.clock = run_by_the_clock(run, options.period_s);
  }
  result.state = run.state();
  result.figures = observer.finish();
  result.buffer_capacity_s = static_cast<double>(feed.queue().capacity()) * options.period_s;
  result.feed_failure = feed.finish();
  result.resumptions = feed.resumptions();
  result.unmeasured_ticks = run.unmeasured_ticks();
  return result;
}

}  // namespace kcs::gateway
