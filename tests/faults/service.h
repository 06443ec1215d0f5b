// What plans for a scene and sends its machine where to go: one kcsd, or several behind a balancer.
#pragma once

#include <chrono>
#include <memory>
#include <optional>
#include <string>

namespace kcs::faults {

class Service {
 public:
  virtual ~Service() = default;

  // For clients and the gateway; the same all the time.
  virtual const std::string& address() const = 0;
  // kill -9 of the kcsd that the machine "bench" is attached to, and a new one with the same plans and runs.
  virtual void kill_and_restart(std::chrono::milliseconds down) = 0;
  // The same by SIGTERM. Throws std::runtime_error if that kcsd does not end with code 0.
  virtual void drain_and_restart(std::chrono::milliseconds down) = 0;
  // Of several: one more is started, and then one drained that the machine is not attached to. Throws
  // std::runtime_error as above, and if the machine goes to another one.
  virtual void exchange_another() = 0;
  // Whether that kcsd stands still.
  virtual void pause(bool paused) = 0;
  // What all kcsd have taken of the processors since they were started, s.
  virtual double cpu_seconds() const = 0;
};

std::unique_ptr<Service> one_server();

// Three with one PostgreSQL, behind HAProxy. Throws std::runtime_error if they do not come up.
std::unique_ptr<Service> replicas();
// Why there can be none here.
std::optional<std::string> missing_for_replicas();

}  // namespace kcs::faults
