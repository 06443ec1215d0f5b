// The drives of a machine, whoever gives them their commands: what they were commanded is the judge.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "server/motion/phase.h"

namespace kcs::faults {

// Of one period.
struct Command {
  motion::Vector position;  // mm
  double time;              // s, on the clock of the drives
};
using Commands = std::vector<Command>;

class Drives {
 public:
  virtual ~Drives() = default;

  // How to start the gateway that is to feed them, as machine "bench".
  virtual std::vector<std::string> gateway_command(const std::string& server) const = 0;
  // Whether they go on while there is no gateway.
  virtual bool outlive_gateway() const = 0;
  // The clock of the drives, s.
  virtual double now() const = 0;
  // All commands until now, after the gateway has ended. Throws std::runtime_error if any is missing.
  virtual Commands record() const = 0;
};

// Simulated ones, inside the gateway.
std::unique_ptr<Drives> simulated_drives();

// Those of LinuxCNC's HAL, with its simulation.hal. Throws std::runtime_error if HAL does not come up.
std::unique_ptr<Drives> hal_drives();
// Why there can be none here.
std::optional<std::string> missing_for_hal();

}  // namespace kcs::faults
