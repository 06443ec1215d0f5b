// The switches of a simulated machine, and the faults that it can be given.
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <filesystem>
#include <thread>

namespace kcs::gateway {

// Files in a folder: a switch is on while the file of its name is there. So a person or a test can throw them from
// outside: `touch FOLDER/drive-fault`, `rm FOLDER/drive-fault`.
//
//   off           the operator has switched the machine off
//   hold          the operator's feed hold
//   drive-fault   a drive reports a fault
//   stuck         the slides stand still, whatever the motors do: a following error builds up
class Switches {
 public:
  enum Switch : std::size_t { kOff, kHold, kDriveFault, kStuck, kCount };

  // Looks into `folder` every 2 ms, on a thread of its own; empty: all switches stay off.
  explicit Switches(const std::filesystem::path& folder);

  // For any thread; does not wait.
  bool is_on(Switch which) const { return on_[which].load(std::memory_order_relaxed); }

 private:
  void look();

  std::filesystem::path folder_;
  std::array<std::atomic<bool>, kCount> on_{};
  std::jthread thread_;  // last: it uses all the others
};

}  // namespace kcs::gateway
