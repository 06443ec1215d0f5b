// Client processes that are killed in the middle of whatever they do.
#pragma once

#include <cstdint>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include "tests/soak/tally.h"
#include "tests/system/child_process.h"

namespace kcs::soak {

// What such a process does: calls the server from several threads until it is killed, or until something comes that
// must not be; then it says so on its standard error. The exit code.
int disturb(const std::string& address, std::uint64_t seed);

// Starts them from this program, as "PROGRAM --disturb ADDRESS --seed N".
class Disturbers {
 public:
  Disturbers(std::string address, std::uint64_t seed) : address_(std::move(address)), random_(seed) {}

  // Kills those whose time has come, and starts others instead. To be called often.
  void attend(Tally& tally);

  int killed() const { return killed_; }

 private:
  struct Process {
    std::unique_ptr<test::ChildProcess> process;
    Clock::time_point end;
  };

  const std::string address_;
  std::mt19937_64 random_;
  std::vector<Process> processes_ = std::vector<Process>(2);
  int killed_ = 0;
};

}  // namespace kcs::soak
