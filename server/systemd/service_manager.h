// Talks to systemd, where that started the program; elsewhere nothing happens. See sd_notify(3).
#pragma once

#include <chrono>
#include <optional>
#include <string>

namespace kcs::systemd {

// Requests are taken from now on; what depends on this service may start. status: a line for `systemctl status`.
void tell_ready(const std::string& status);

// The service is stopping, and its end is no failure.
void tell_stopping(const std::string& status);

// The program lives. To be told more often than watchdog_period(), or systemd ends and restarts it.
void tell_alive();

// Nothing if systemd does not watch the program.
std::optional<std::chrono::microseconds> watchdog_period();

}  // namespace kcs::systemd
