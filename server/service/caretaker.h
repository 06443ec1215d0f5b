// Looks after the archive: opens it, plans what waits in it, forgets what is old.
#pragma once

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <stop_token>
#include <string>
#include <thread>

#include "server/jobs/plan_desk.h"
#include "server/observe/readiness.h"
#include "server/service/archive.h"
#include "server/service/caps.h"

namespace kcs::service {

// A server is ready as long as its database answers. All that waits there without outcome, because its server died or
// could not write the outcome down, is taken up here.
class Caretaker {
 public:
  // Keeps references to all. lease: StoreSettings::lease. Opens the archive, or if its database is not there yet goes
  // on trying in a thread of its own. Throws store::StoreError if the database cannot be used at all.
  Caretaker(Archive& archive, jobs::PlanDesk& desk, observe::Readiness& readiness, const Caps& caps,
            std::chrono::milliseconds lease);
  ~Caretaker() { stop(); }
  Caretaker(const Caretaker&) = delete;
  Caretaker& operator=(const Caretaker&) = delete;

  // Gives back what is not planned yet, so that another server takes it up at once.
  void stop();

 private:
  void work(const std::stop_token& stop);
  // One round. True if the database answered.
  bool attend();
  void take_up(const std::string& name);

  Archive& archive_;
  jobs::PlanDesk& desk_;
  observe::Readiness& readiness_;
  const Caps& caps_;
  const std::chrono::milliseconds lease_;
  std::chrono::steady_clock::time_point swept_{};
  std::mutex mutex_;
  std::condition_variable_any never_;  // comes; but a stop ends waiting for it
  std::jthread thread_;
};

}  // namespace kcs::service
