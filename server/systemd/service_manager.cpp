#include "server/systemd/service_manager.h"

#include <systemd/sd-daemon.h>

#include <cstdint>

namespace kcs::systemd {
namespace {

// What sd_notify() answers is not looked at: a service does not fail because its manager does not listen.
void tell(const std::string& state) { sd_notify(0, state.c_str()); }

}  // namespace

void tell_ready(const std::string& status) { tell("READY=1\nSTATUS=" + status); }

void tell_stopping(const std::string& status) { tell("STOPPING=1\nSTATUS=" + status); }

void tell_alive() { tell("WATCHDOG=1"); }

std::optional<std::chrono::microseconds> watchdog_period() {
  std::uint64_t period = 0;
  if (sd_watchdog_enabled(0, &period) <= 0) return std::nullopt;
  return std::chrono::microseconds(period);
}

}  // namespace kcs::systemd
