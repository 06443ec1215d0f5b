#include "tests/bench/live/server_process.h"

#include <signal.h>
#include <unistd.h>

#include <fstream>
#include <sstream>
#include <stdexcept>

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

double ServerProcess::cpu_seconds() const {
  std::ifstream file("/proc/" + std::to_string(kcsd_.process().pid()) + "/stat");
  std::string line;
  std::getline(file, line);
  std::istringstream fields(line.substr(line.rfind(')') + 1));  // the name before it may have blanks
  constexpr int kBefore = 11;                                   // fields between the name and the times
  std::string skipped;
  for (int i = 0; i < kBefore; ++i) fields >> skipped;
  double user = 0, system = 0;
  if (!(fields >> user >> system)) throw std::runtime_error("kcsd is gone: " + kcsd_.process().errors());
  return (user + system) / static_cast<double>(sysconf(_SC_CLK_TCK));
}

}  // namespace kcs::bench
