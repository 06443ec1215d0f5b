#include "tests/bench/live/server_process.h"

#include <fstream>
#include <stdexcept>

namespace kcs::bench {

ServerProcess::ServerProcess() : process_({KCSD, "--listen", "127.0.0.1:0", "--log-level", "warning"}) {
  const std::string greeting = process_.read_line();
  const std::size_t blank = greeting.rfind(' ');
  if (blank == std::string::npos) throw std::runtime_error("kcsd does not start: " + process_.errors());
  address_ = greeting.substr(blank + 1);
}

std::size_t ServerProcess::status(const std::string& key) const {
  std::ifstream file("/proc/" + std::to_string(process_.pid()) + "/status");
  for (std::string word; file >> word;) {
    std::size_t kilobytes = 0;
    if (word == key && file >> kilobytes) return kilobytes * 1024;
  }
  throw std::runtime_error("kcsd is gone: " + process_.errors());
}

}  // namespace kcs::bench
