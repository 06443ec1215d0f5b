#include "client/gateway/setpoint_feed.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <condition_variable>
#include <mutex>
#include <stdexcept>
#include <string_view>
#include <utility>

namespace kcs::gateway {
namespace {

using Clock = std::chrono::steady_clock;
using std::chrono::milliseconds;

constexpr milliseconds kFirstPause{50};
constexpr milliseconds kLongestPause{1000};
constexpr milliseconds kPatience{10'000};
constexpr milliseconds kPollInterval{1};  // of a full queue: far shorter than the queue lasts

// How many setpoints to ask for at a time.
std::uint32_t piece_size(std::size_t capacity) {
  return static_cast<std::uint32_t>(std::clamp<std::size_t>(capacity / 4, 2, 32'768));
}

// Whether the same call may succeed later.
bool may_pass(const client::Error& error) {
  constexpr std::array<std::string_view, 7> kFinal = {"INVALID_ARGUMENT",  "NOT_FOUND",       "FAILED_PRECONDITION",
                                                      "PERMISSION_DENIED", "UNAUTHENTICATED", "OUT_OF_RANGE",
                                                      "UNIMPLEMENTED"};
  return std::find(kFinal.begin(), kFinal.end(), error.code()) == kFinal.end();
}

void pause(milliseconds time, const std::stop_token& stop) {
  std::mutex mutex;
  std::unique_lock lock(mutex);
  std::condition_variable_any().wait_for(lock, stop, time, [] { return false; });
}

}  // namespace

SetpointFeed::SetpointFeed(PlanSource source, const FeedOptions& options)
    : queue_(options.capacity),
      source_(std::move(source)),
      options_(options),
      thread_([this](const std::stop_token& stop) { run(stop); }) {}

std::string SetpointFeed::finish() {
  thread_.request_stop();
  thread_.join();
  if (complete_) return "";
  return broken_ ? trouble_ : fmt::format("the server sent nothing from setpoint {} on", next_index_);
}

void SetpointFeed::run(const std::stop_token& stop) {
  auto broken_since = Clock::now();
  milliseconds next_pause = kFirstPause;
  bool hopeful = true;
  while (!complete_ && hopeful && !stop.stop_requested()) {
    try {
      if (broken_) source_.reconnect(stop);
      fetch(stop);
    } catch (const client::Error& error) {
      if (stop.stop_requested()) break;  // our own doing
      if (!std::exchange(broken_, true)) {
        broken_since = Clock::now();
        next_pause = kFirstPause;
      }
      trouble_ = fmt::format("{} ({}, at setpoint {})", error.what(), error.code(), next_index_);
      hopeful = may_pass(error) && Clock::now() - broken_since < kPatience;
      if (hopeful) pause(std::exchange(next_pause, std::min(2 * next_pause, kLongestPause)), stop);
    } catch (const std::exception& error) {
      broken_ = true;
      trouble_ = error.what();
      hopeful = false;
    }
  }
  ended_.store(true, std::memory_order_release);
}

void SetpointFeed::fetch(const std::stop_token& stop) {
  const std::uint32_t piece = piece_size(queue_.capacity());
  while (queue_.capacity() - queue_.size() < piece) {
    if (stop.stop_requested()) return;
    std::this_thread::sleep_for(kPollInterval);
  }
  const std::uint64_t end = next_index_ + piece;
  client::SetpointStream stream = source_.open({.period_s = options_.period_s,
                                                .first_index = next_index_,
                                                .channels = {},
                                                .batch_size = piece,
                                                .last_index = end - 1},
                                               stop);
  for (client::SetpointBatch batch; !complete_ && stream.next(batch);) {
    check(batch);
    put(batch);
  }
  if (!complete_ && next_index_ < end) {
    throw std::runtime_error(fmt::format("the server ended the stream before setpoint {}", next_index_));
  }
}

void SetpointFeed::check(const client::SetpointBatch& batch) const {
  const auto is_whole = [&batch](const auto& column) { return column.size() == batch.size(); };
  if (batch.first_index == next_index_ && batch.position_mm.size() == options_.axes &&
      std::all_of(batch.position_mm.begin(), batch.position_mm.end(), is_whole) &&
      batch.size() <= queue_.capacity() - queue_.size()) {
    return;
  }
  throw std::runtime_error(
      fmt::format("the server sent {} setpoints of {} axes from {} on, which is not what it was "
                  "asked for at {}; use a server of the gateway's version",
                  batch.size(), batch.position_mm.size(), batch.first_index, next_index_));
}

void SetpointFeed::put(const client::SetpointBatch& batch) {
  if (std::exchange(broken_, false)) ++resumptions_;
  const std::uint64_t end_of_path = batch.setpoint_count - 1;
  const std::uint64_t last = std::min(options_.last_index.value_or(end_of_path), end_of_path);
  for (std::size_t entry = 0; entry < batch.size() && !complete_; ++entry, ++next_index_) {
    Setpoint setpoint = {.last = next_index_ == last};
    for (std::size_t axis = 0; axis < options_.axes; ++axis) {
      setpoint.position_mm[static_cast<Eigen::Index>(axis)] = batch.position_mm[axis][entry];
    }
    queue_.put(setpoint);
    complete_ = setpoint.last;
  }
}

}  // namespace kcs::gateway
