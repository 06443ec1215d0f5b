// A kcsd of its own.
#pragma once

#include <sys/types.h>

#include <cstddef>
#include <string>
#include <vector>

#include "tests/system/kcsd_process.h"

namespace kcs::bench {

// Serves until this object goes: then it is killed (SIGKILL), if it still runs.
class ServerProcess {
 public:
  // flags: where it listens, or what says so. Throws std::runtime_error if it does not start.
  explicit ServerProcess(const std::vector<std::string>& flags = {"--listen", "127.0.0.1:0", "--database", "memory"});

  const std::string& address() const { return kcsd_.address(); }

  // Memory of the process that is really there, bytes: now, and the most so far.
  std::size_t memory() const { return kcsd_.status_figure("VmRSS:") * 1024; }
  std::size_t most_memory() const { return kcsd_.status_figure("VmHWM:") * 1024; }

  int threads() const { return static_cast<int>(kcsd_.status_figure("Threads:")); }

  pid_t pid() const { return kcsd_.process().pid(); }

  // Asks it to stop (SIGTERM), and waits for up to a minute. Its exit code.
  int stop();

  // What it wrote to its log so far: warnings and errors.
  std::string log() const { return kcsd_.process().errors(); }

  // Time that its threads have taken of the processors so far, s.
  double cpu_seconds() const { return kcsd_.cpu_seconds(); }

 private:
  test::KcsdProcess kcsd_;
};

}  // namespace kcs::bench
