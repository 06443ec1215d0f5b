#include "client/gateway/machine/attach.h"

#include <signal.h>
#include <spdlog/sinks/stdout_sinks.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <memory>
#include <thread>

#include "client/common/file_error.h"
#include "client/gateway/machine/feeder.h"
#include "client/gateway/machine/machine_link.h"
#include "client/gateway/machine/player_memory.h"
#include "client/gateway/machine/simulated_machine.h"
#include "client/gateway/observer.h"
#include "client/gateway/real_time.h"

namespace kcs::gateway {
namespace {

using std::chrono::milliseconds;

constexpr milliseconds kFeedEvery{4};
constexpr milliseconds kLookForRest{5};
constexpr time_t kLookForTicks = 2;  // s: far more than a period
constexpr int kUnreadAtMost = 3;
constexpr milliseconds kLastReport{100};  // for the server to hear that the machine rests
constexpr double kLongestTail = KCS_PLAYER_SETPOINTS;
constexpr double kMoreThanATail = 5;  // s

std::shared_ptr<spdlog::logger> make_log() {
  auto log = std::make_shared<spdlog::logger>("kcs-gateway", std::make_shared<spdlog::sinks::stderr_sink_mt>());
  log->set_pattern("%Y-%m-%dT%H:%M:%S.%e%z %l %v");
  log->flush_on(spdlog::level::info);
  return log;
}

// The signals that end the program; they wait for wait() as long as this lives, in every thread that begins later.
class EndSignals {
 public:
  EndSignals() {
    sigemptyset(&signals_);
    sigaddset(&signals_, SIGTERM);
    sigaddset(&signals_, SIGINT);
    pthread_sigmask(SIG_BLOCK, &signals_, &before_);
  }
  ~EndSignals() { pthread_sigmask(SIG_SETMASK, &before_, nullptr); }
  EndSignals(const EndSignals&) = delete;
  EndSignals& operator=(const EndSignals&) = delete;

  // True when one has come, false after `seconds`.
  bool wait_for(time_t seconds) const {
    const timespec timeout = {.tv_sec = seconds};
    return sigtimedwait(&signals_, nullptr, &timeout) > 0;
  }

 private:
  sigset_t signals_{};
  sigset_t before_{};
};

// The drives of the simulated driver, and who watches them.
class SimulatedSide {
 public:
  SimulatedSide(kcs_player_memory& memory, const SimulatedSettings& settings,
                const std::optional<std::filesystem::path>& record)
      : switches_(settings.switches),
        observer_({.axes = memory.profile.axes, .period_s = memory.profile.period_s, .record = record}),
        machine_(memory, start_of(settings), settings.clock_drift_ppm, switches_, observer_.trace()) {}

  const SimulatedMachine& machine() const { return machine_; }

  void finish(spdlog::logger& log) {
    const ClockFigures clock = machine_.finish();
    const RunFigures figures = observer_.finish();
    const auto late = [&clock](double share) { return clock.lateness.percentile_us(share); };
    log.info(
        "jitter ticks={} p50_us={:.0f} p90_us={:.0f} p99_us={:.0f} p99_9_us={:.0f} p99_99_us={:.0f} max_us={:.0f} "
        "late_ticks={} missed_periods={} out_of_step_us={:.1f} fifo={} memory_locked={} unrecorded_ticks={}",
        figures.ticks, late(0.5), late(0.9), late(0.99), late(0.999), late(0.9999), clock.lateness.max_us(),
        clock.late_ticks, clock.missed_periods, clock.out_of_step_us, clock.fifo, clock.memory_locked,
        machine_.untraced_ticks());
  }

 private:
  static Vector start_of(const SimulatedSettings& settings) {
    Vector start = Vector::Zero();
    std::copy(settings.start_mm.begin(), settings.start_mm.end(), start.begin());
    return start;
  }

  Switches switches_;
  Observer observer_;
  SimulatedMachine machine_;
};

v1::MachineHello make_hello(const Settings& settings, const kcs_player_profile& profile) {
  v1::MachineHello hello;
  hello.set_machine(settings.machine);
  hello.mutable_limits()->set_axes(profile.axes);
  for (std::uint32_t axis = 0; axis < profile.axes; ++axis) {
    hello.mutable_limits()->add_velocity_mm_s(profile.velocity_mm_s[axis]);
    hello.mutable_limits()->add_acceleration_mm_s2(profile.acceleration_mm_s2[axis]);
    hello.mutable_limits()->add_jerk_mm_s3(profile.jerk_mm_s3[axis]);
  }
  const auto batch = static_cast<std::uint32_t>(std::max(1.0, std::round(settings.stream.batch_s / profile.period_s)));
  hello.set_period_s(profile.period_s);
  hello.set_batch_size(batch);
  hello.set_window_s(settings.stream.window_s);
  hello.set_tail_capacity(KCS_PLAYER_SETPOINTS - batch);
  hello.set_report_s(settings.stream.report_s);
  hello.set_instance(fmt::format("{}-{}", getpid(), std::chrono::system_clock::now().time_since_epoch().count()));
  return hello;
}

// Waits for the end, and looks meanwhile whether the player still ticks. False if it does not: then the component was
// unloaded, and its memory is nobody's now.
bool wait_for_end(const EndSignals& end, const kcs_player_memory& memory) {
  std::optional<std::uint64_t> ticks;
  // Who writes the report may be kept from running just then; once in a while that means nothing.
  for (int unread = 0; unread < kUnreadAtMost;) {
    kcs_player_report report{};
    if (!kcs_player_read(&memory, &report)) {
      ++unread;
    } else if (report.ticks == ticks) {
      return false;
    } else {
      ticks = report.ticks;
      unread = 0;
    }
    if (end.wait_for(kLookForTicks)) return true;
  }
  return false;
}

// False if the player does not come to rest: it may not tick any more.
bool bring_to_rest(Feeder& feeder, double period_s) {
  using Clock = std::chrono::steady_clock;
  const std::chrono::duration<double> longest_stop(kLongestTail * period_s + kMoreThanATail);
  feeder.shut_down();
  for (const auto begin = Clock::now(); Clock::now() - begin < longest_stop;) {
    std::this_thread::sleep_for(kLookForRest);
    if (feeder.at_rest()) return true;
  }
  return false;
}

}  // namespace

client::ExitCode attach(const Settings& settings, const std::optional<std::filesystem::path>& record) {
  const bool simulated = settings.driver == Driver::kSimulated;
  if (record && !simulated) {
    throw client::FileError("--record is for the simulated driver; record HAL's pins with sampler");
  }
  const EndSignals end;
  const std::shared_ptr<spdlog::logger> log = make_log();
  const PlayerMemory memory =
      simulated ? make_player_memory(settings.simulated.profile) : open_player_memory(settings.hal_component);
  std::optional<SimulatedSide> drives;
  FeederOptions options{.machine = settings.machine, .commit_s = settings.stream.commit_s};
  if (simulated) {
    drives.emplace(*memory, settings.simulated, record);
    options.late_ticks = [&drives] { return drives->machine().late_ticks(); };
  }
  Feeder feeder(*memory, options, log);
  MachineLink link(settings.server, make_hello(settings, memory->profile), feeder, log);
  log->info("begins machine={} driver={} period_s={}", settings.machine, simulated ? "simulated" : "hal",
            memory->profile.period_s);
  // Whoever holds the feeder's lock runs in real time, so that a busy computer does not keep motion from the player.
  const std::jthread feeding([&feeder](const std::stop_token& stop) {
    feed_in_real_time();
    while (!stop.stop_requested()) {
      feeder.step();
      std::this_thread::sleep_for(kFeedEvery);
    }
  });
  {
    const std::jthread linking([&link](const std::stop_token& stop) {
      feed_in_real_time();
      link.run(stop);
    });
    if (!wait_for_end(end, *memory)) {
      throw client::FileError("the player ticks no more: is HAL still running? Start it, then the gateway again");
    }
    log->info("ends: brings the machine to rest");
    if (!bring_to_rest(feeder, memory->profile.period_s)) log->error("the player does not answer; look at the machine");
    std::this_thread::sleep_for(kLastReport);
  }
  if (drives) drives->finish(*log);
  return client::kDone;
}

}  // namespace kcs::gateway
