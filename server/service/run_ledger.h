// Writes down how runs go.
#pragma once

#include <condition_variable>
#include <map>
#include <mutex>
#include <stop_token>
#include <string>
#include <thread>

#include "server/runs/run.h"
#include "server/service/archive.h"

namespace kcs::service {

store::RunRecord encode_record(const runs::Run& run);
runs::Run decode_record(const store::RunRecord& record);

// Takes notes at once and writes them in a thread of its own: a database that does not answer holds up no machine.
// Until it answers, only the latest of each run is kept. Safe for use by many threads at once.
class RunLedger {
 public:
  // Keeps a reference to it.
  explicit RunLedger(Archive& archive);
  // Tries once more to write what is left.
  ~RunLedger();
  RunLedger(const RunLedger&) = delete;
  RunLedger& operator=(const RunLedger&) = delete;

  void note(const runs::Run& run);

 private:
  void work(const std::stop_token& stop);
  bool write(const store::RunRecord& record);

  Archive& archive_;
  std::mutex mutex_;
  std::condition_variable_any noted_;
  std::map<std::string, store::RunRecord> notes_;
  std::jthread thread_;  // last: it uses all the others
};

}  // namespace kcs::service
