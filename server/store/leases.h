// Who plans what: each accepted request is one server's for a while, which it prolongs as long as it lives.
#pragma once

#include <chrono>
#include <cstddef>
#include <string>
#include <vector>

#include "server/store/connections.h"

namespace kcs::store {

// The leases of one server.
class Leases {
 public:
  // `duration`: how long a server may be silent before others take over.
  explicit Leases(std::chrono::milliseconds duration);

  // This server among all others, and among all its past lives.
  const std::string& planner() const { return planner_; }

  // Takes an accepted plan unless somebody has it. Inside a transaction on its name.
  void take(soci::session& session, const Dialect& dialect, const std::string& name) const;

  // Prolongs this server's leases and takes over some that have ended, until it has `most`. All its plans then.
  std::vector<std::string> claim(Connections& connections, std::size_t most) const;

  // Ends this server's leases.
  void release(Connections& connections) const;

 private:
  const long long duration_;  // µs
  const std::string planner_;
};

}  // namespace kcs::store
