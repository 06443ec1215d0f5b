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

ServerProcess::ServerProcess(const std::vector<std::string>& flags) : process_(command(flags)) {
  const std::string greeting = process_.read_line();
  const std::size_t blank = greeting.rfind(' ');
  if (blank == std::string::npos) throw std::runtime_error("kcsd does not start: " + process_.errors());
  address_ = greeting.substr(blank + 1);
}

int ServerProcess::stop() {
  process_.send_signal(SIGTERM);
  return process_.wait();
}

double ServerProcess::cpu_seconds() const {
  std::ifstream file("/proc/" + std::to_string(process_.pid()) + "/stat");
  std::string line;
  std::getline(file, line);
  std::istringstream fields(line.substr(line.rfind(')') + 1));  // the name before it may have blanks
  constexpr int kBefore = 11;                                   // fields between the name and the times
  std::string skipped;
  for (int i = 0; i < kBefore; ++i) fields >> skipped;
  double user = 0, system = 0;
  if (!(fields >> user >> system)) throw std::runtime_error("kcsd is gone: " + process_.errors());
  return (user + system) / static_cast<double>(sysconf(_SC_CLK_TCK));
}

std::size_t ServerProcess::status(const std::string& key) const {
  std::ifstream file("/proc/" + std::to_string(process_.pid()) + "/status");
  for (std::string word; file >> word;) {
    std::size_t number = 0;
    if (word == key && file >> number) return number;
  }
  throw std::runtime_error("kcsd is gone: " + process_.errors());
}

}  // namespace kcs::bench
