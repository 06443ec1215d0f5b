// The tokens that are kept in a file of their own, so that they can be given and revoked while the server runs.
#pragma once

#include <chrono>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "server/security/callers.h"

namespace kcs::service {

// Holds [[tokens]] like the configuration. A change takes effect within a second; a file that cannot be read is
// reported in the log, and the tokens from before stay valid. Safe for use by many threads at once.
class TokensFile {
 public:
  using Tokens = std::shared_ptr<const std::vector<security::KnownToken>>;

  // Throws std::runtime_error, with the place, if the file cannot be read.
  explicit TokensFile(std::string file);

  // Those that are valid now.
  Tokens tokens();

 private:
  void read();

  const std::string file_;
  std::mutex mutex_;
  std::chrono::steady_clock::time_point next_look_;
  std::string text_;  // that was seen last
  Tokens tokens_;
  std::string trouble_;  // that was reported last
};

}  // namespace kcs::service
