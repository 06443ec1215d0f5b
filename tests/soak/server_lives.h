// A kcsd that is killed and started again on the same address, with the same store.
#pragma once

#include <atomic>
#include <filesystem>
#include <memory>
#include <string>

#include "tests/bench/live/server_process.h"
#include "tests/soak/resources.h"
#include "tests/soak/tally.h"

namespace kcs::soak {

class ServerLives {
 public:
  // Starts the first one. folder: for its settings and its store. Throws std::runtime_error if it does not start.
  explicit ServerLives(const std::filesystem::path& folder);

  const std::string& address() const { return address_; }

  // kill -9, and the next one.
  void kill_and_restart();
  // SIGTERM, and the next one. The exit code.
  int stop_and_restart();

  // Whether there was no server at some time since then, or only just again.
  bool outage_since(Clock::time_point since) const;

  // What it takes now. Throws std::runtime_error if it does not tell. Not while it is killed and restarted.
  Resources resources() const;
  // Warnings and errors of the server that runs.
  std::string log() const { return server_->log(); }

 private:
  void start();

  const std::string address_;
  const std::string http_address_;
  const std::string settings_;
  std::unique_ptr<bench::ServerProcess> server_;
  std::atomic<bool> down_ = false;
  std::atomic<Clock::time_point> last_outage_ = Clock::time_point();
};

}  // namespace kcs::soak
