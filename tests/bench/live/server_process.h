// A kcsd of its own.
#pragma once

#include <cstddef>
#include <string>

#include "tests/system/child_process.h"

namespace kcs::bench {

// Serves on a free port of the loopback; ends with this object.
class ServerProcess {
 public:
  // Throws std::runtime_error if it does not start.
  ServerProcess();

  const std::string& address() const { return address_; }

  // Memory of the process that is really there, bytes: now, and the most so far.
  std::size_t memory() const { return status("VmRSS:"); }
  std::size_t most_memory() const { return status("VmHWM:"); }

  // Time that its threads have taken of the processors so far, s.
  double cpu_seconds() const;

 private:
  std::size_t status(const std::string& key) const;

  test::ChildProcess process_;
  std::string address_;
};

}  // namespace kcs::bench
