#include "server/service/caretaker.h"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <exception>
#include <optional>
#include <utility>

#include "server/jobs/cap_exceeded.h"
#include "server/service/request_code.h"

namespace kcs::service {
namespace {

constexpr std::chrono::seconds kRetry{1};
constexpr std::chrono::minutes kSweep{1};
constexpr int kRoundsPerLease = 4;  // the store asks for three
// However long the lease: so soon it is seen that the database has gone, or that there is something to take up.
constexpr std::chrono::seconds kLongestPause{5};

constexpr const char* kNotReached = "the store is not reached";

// Who pays for what nobody waits for.
constexpr const char* kClient = "plans taken up again";

}  // namespace

Caretaker::Caretaker(Archive& archive, jobs::PlanDesk& desk, observe::Readiness& readiness, const Caps& caps,
                     std::chrono::milliseconds lease)
    : archive_(archive), desk_(desk), readiness_(readiness), caps_(caps), lease_(lease) {
  attend();
  thread_ = std::jthread([this](const std::stop_token& stop) { work(stop); });
}

void Caretaker::stop() {
  if (!thread_.joinable()) return;
  thread_.request_stop();
  thread_.join();
  try {
    archive_.release();
  } catch (const store::StoreError& failure) {
    spdlog::warn("what waits to be planned is planned by others only later: {}", failure.what());
  }
}

void Caretaker::work(const std::stop_token& stop) {
  bool answers = readiness_.obstacle().empty();
  while (!stop.stop_requested()) {
    const auto pause = std::min<std::chrono::milliseconds>(answers ? kLongestPause : kRetry, lease_ / kRoundsPerLease);
    std::unique_lock lock(mutex_);
    if (never_.wait_for(lock, stop, pause, [] { return false; }) || stop.stop_requested()) return;
    try {
      answers = attend();
    } catch (const std::exception& failure) {
      answers = false;
      readiness_.set_not_ready("the store needs its operator");
      spdlog::error("the store needs its operator: {}", failure.what());
    }
  }
}

bool Caretaker::attend() {
  try {
    archive_.open();
    const std::size_t waiting = desk_.load().waiting;
    const auto room = caps_.queue_length > waiting ? caps_.queue_length - waiting : 0;
    for (const std::string& name : archive_.claim(room)) take_up(name);
    if (const auto now = std::chrono::steady_clock::now(); now - swept_ > kSweep) {
      archive_.sweep();
      swept_ = now;
    }
  } catch (const store::StoreUnavailable& unavailable) {
    if (readiness_.obstacle() != kNotReached) spdlog::warn("the store is not reached: {}", unavailable.what());
    readiness_.set_not_ready(kNotReached);
    return false;
  } catch (const store::StoreFull& full) {
    spdlog::error("cannot take requests: {}", full.what());
    if (!archive_.is_open()) {
      readiness_.set_not_ready("the store has no room to be opened");
      return false;
    }
    // What is there can still be read.
  }
  readiness_.set_ready();
  return true;
}

void Caretaker::take_up(const std::string& name) {
  if (const jobs::PlanPointer made = archive_.find(name)) return archive_.finish(*made);
  if (desk_.watch(name)) return;
  const std::optional<std::string> bytes = archive_.request(name);
  if (!bytes) return;
  try {
    desk_.submit(decode_request(name, *bytes, caps_), kClient, jobs::Priority::kNormal).go_on_alone();
  } catch (const jobs::CapExceeded& reached) {
    // Where too many wait, the next round has room, or another server.
    if (!reached.retry_after()) archive_.refuse({.name = name}, std::current_exception());
  } catch (const store::StoreError&) {
    throw;
  } catch (const std::exception& defect) {
    spdlog::error("cannot plan {}, which was accepted: {}", name, defect.what());
    archive_.refuse({.name = name}, std::current_exception());
  }
}

}  // namespace kcs::service
