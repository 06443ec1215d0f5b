// LinuxCNC's HAL with the player in it: client/gateway/hal/simulation.hal, in namespaces of its own.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "tests/system/child_process.h"

namespace kcs::test {

// What the drives got in one period.
struct HalSample {
  double command_mm[3];
  int state;           // enum kcs_player_state
  unsigned long tick;  // of the player
};

class HalMachine {
 public:
  // Why there cannot be one here; nothing if there can.
  static std::optional<std::string> missing();

  // Switched on and standing at the beginning of a Line. Throws std::runtime_error if HAL does not come up.
  HalMachine();
  ~HalMachine();
  HalMachine(const HalMachine&) = delete;
  HalMachine& operator=(const HalMachine&) = delete;

  // A command of halcmd, done when this returns.
  void command(const std::vector<std::string>& words) const;
  // A file as HAL's own processes see it.
  std::filesystem::path file(const std::string& path) const { return "/proc/" + pid_ + "/root" + path; }
  // Starts a feeder.
  ChildProcess feeder(double length_mm) const;
  // Once a run has come to its end: all that has been sampled, until the machine was READY again.
  std::vector<HalSample> record() const;
  // All that has been sampled, once that goes as far as this tick of the player.
  std::vector<HalSample> record_until(unsigned long tick) const;
  // How to start a program as HAL's user, among HAL's own processes.
  std::vector<std::string> inside(const std::vector<std::string>& arguments) const;
  ChildProcess start(const std::vector<std::string>& arguments) const { return ChildProcess(inside(arguments)); }

 private:
  std::vector<HalSample> record_until(const std::function<bool(const HalSample&)>& is_end) const;

  std::string folder_;
  std::optional<ChildProcess> hal_;
  std::string pid_;  // of the first process in the namespaces
};

}  // namespace kcs::test
