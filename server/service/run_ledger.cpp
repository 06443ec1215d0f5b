#include "server/service/run_ledger.h"

#include <spdlog/spdlog.h>

#include <chrono>
#include <utility>

namespace kcs::service {
namespace {

constexpr std::chrono::seconds kRetry{1};

store::RunRecordState encode_state(runs::RunState state) {
  switch (state) {
    case runs::RunState::kFinished:
      return store::RunRecordState::kFinished;
    case runs::RunState::kAborted:
      return store::RunRecordState::kAborted;
    case runs::RunState::kFailed:
      return store::RunRecordState::kFailed;
    default:
      return store::RunRecordState::kOpen;
  }
}

runs::RunState decode_state(const store::RunRecord& record) {
  switch (record.state) {
    case store::RunRecordState::kFinished:
      return runs::RunState::kFinished;
    case store::RunRecordState::kAborted:
      return runs::RunState::kAborted;
    case store::RunRecordState::kFailed:
      return runs::RunState::kFailed;
    case store::RunRecordState::kOpen:
      break;
  }
  return record.held ? runs::RunState::kHeld : runs::RunState::kWaiting;
}

}  // namespace

store::RunRecord encode_record(const runs::Run& run) {
  return {.name = run.name,
          .machine = run.name.substr(0, run.name.find("/runs/")),
          .plan = run.plan,
          .controller = run.controller,
          .state = encode_state(run.state),
          .held = run.hold_asked || run.state == runs::RunState::kHeld,
          .feed_override = run.rate,
          .plan_time = run.plan_time,
          .reason = run.reason,
          .create_time = run.create_time};
}

runs::Run decode_record(const store::RunRecord& record) {
  return {.name = record.name,
          .plan = record.plan,
          .controller = record.controller,
          .state = decode_state(record),
          .rate = record.feed_override,
          .create_time = record.create_time,
          .plan_time = record.plan_time,
          .reason = record.reason,
          .hold_asked = record.held};
}

RunLedger::RunLedger(Archive& archive)
    : archive_(archive), thread_([this](const std::stop_token& stop) { work(stop); }) {}

RunLedger::~RunLedger() {
  thread_.request_stop();
  thread_.join();
  for (const auto& [name, record] : notes_) write(record);
}

void RunLedger::note(const runs::Run& run) {
  const std::lock_guard lock(mutex_);
  notes_[run.name] = encode_record(run);
  noted_.notify_all();
}

void RunLedger::work(const std::stop_token& stop) {
  std::unique_lock lock(mutex_);
  while (noted_.wait(lock, stop, [this] { return !notes_.empty(); })) {
    const store::RunRecord record = notes_.begin()->second;
    notes_.erase(notes_.begin());
    lock.unlock();
    const bool written = write(record);
    lock.lock();
    if (written) continue;
    notes_.try_emplace(record.name, record);  // unless there is a later one
    noted_.wait_for(lock, stop, kRetry, [] { return false; });
  }
}

bool RunLedger::write(const store::RunRecord& record) {
  try {
    archive_.update_run(record);
    return true;
  } catch (const store::StoreUnavailable& unavailable) {
    spdlog::warn("how {} goes is not written down yet: {}", record.name, unavailable.what());
  } catch (const store::StoreFull& full) {
    spdlog::warn("how {} goes is not written down yet: {}", record.name, full.what());
  } catch (const std::exception& failure) {
    spdlog::error("how {} goes cannot be written down: {}", record.name, failure.what());
    return true;
  }
  return false;
}

}  // namespace kcs::service
