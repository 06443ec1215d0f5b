// When threads were not run that were due: none at all, because the computer itself was away (a virtual one whose host
// let others run, one whose firmware had something to do), or only ordinary ones, because others went before them.
#pragma once

#include <chrono>
#include <mutex>
#include <thread>
#include <vector>

namespace kcs::faults {

struct Absence {
  bool of_the_computer = false;  // else of ordinary threads only
  std::chrono::system_clock::time_point end;
  std::chrono::milliseconds length;
};

// Watches each processor by a thread that nothing on this computer goes before, and by an ordinary one, from the
// beginning of its life on.
class AbsenceWatch {
 public:
  // Throws std::runtime_error where threads may have no real-time priority: then they would only see other threads.
  AbsenceWatch();

  // Of 20 ms or longer, on any processor, so far. Ordinary threads are away with the computer as well.
  std::vector<Absence> absences() const;

 private:
  void watch(const std::stop_token& stop, bool computer);

  mutable std::mutex mutex_;
  std::vector<Absence> absences_;
  std::vector<std::jthread> watchers_;  // last: they use the others
};

}  // namespace kcs::faults
