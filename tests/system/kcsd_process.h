// A kcsd that has started.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "tests/system/child_process.h"

namespace kcs::test {

class KcsdProcess {
 public:
  // command: the program and its flags, or what starts it. Throws std::runtime_error if it does not start.
  explicit KcsdProcess(const std::vector<std::string>& command);

  ChildProcess& process() { return process_; }
  const ChildProcess& process() const { return process_; }
  // Where it listens, as it says itself.
  const std::string& address() const { return address_; }

  // The number after a word in the process's /proc/…/status, such as "Threads:" or "VmRSS:" (kB). Throws
  // std::runtime_error if the process is gone.
  std::size_t status_figure(const std::string& word) const;

  // Time that its threads have taken of the processors so far, s. Throws likewise.
  double cpu_seconds() const;

 private:
  ChildProcess process_;
  std::string address_;
};

// Where kcsd shows its figures, from its log. Throws std::runtime_error if it does not say so in time.
std::string http_address_of(const ChildProcess& kcsd);

}  // namespace kcs::test
