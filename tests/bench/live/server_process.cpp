#include "tests/bench/live/server_process.h"

#include <signal.h>

namespace kcs::bench {
namespace {

std::vector<std::string> command(const std::vector<std::string>& flags) {
  std::vector<std::string> words = {KCSD, "--log-level", "warning"};
  words.insert(words.end(), flags.begin(), flags.end());
  return words;
}

}  // namespace

ServerProcess::ServerProcess(const std::vector<std::string>& flags) : kcsd_(command(flags)) {}

int ServerProcess::stop() {
  kcsd_.process().send_signal(SIGTERM);
  return kcsd_.process().wait();
}

}  // namespace kcs::bench
