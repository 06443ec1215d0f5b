#include "client/gateway/observer.h"

#include <chrono>
#include <utility>

namespace kcs::gateway {
namespace {

constexpr std::size_t kTraceCapacity = 65'536;  // ticks: seconds of them at any period that a clock can keep
constexpr std::chrono::milliseconds kPollInterval{1};

}  // namespace

Observer::Observer(ObserverOptions options)
    : options_(std::move(options)), trace_(kTraceCapacity), measurement_(options_.period_s) {
  if (options_.record) recording_.emplace(*options_.record, options_.axes, options_.period_s);
  thread_ = std::jthread([this](const std::stop_token& stop) { run(stop); });
}

RunFigures Observer::finish() {
  thread_.request_stop();
  thread_.join();
  if (recording_) recording_->finish();
  return measurement_.finish();
}

void Observer::run(const std::stop_token& stop) {
  std::uint64_t ticks = 0;
  for (bool last_round = false; !last_round;) {
    last_round = stop.stop_requested();  // asked before the trace is emptied: what is put before the stop is seen
    for (Tick tick; trace_.take(tick); ++ticks) {
      measurement_.add(tick);
      if (recording_) recording_->add(tick);
    }
    if (options_.on_progress) options_.on_progress(ticks);
    if (!last_round) std::this_thread::sleep_for(kPollInterval);
  }
}

}  // namespace kcs::gateway
