#include "tests/system/kcsd_process.h"

#include <unistd.h>

#include <fstream>
#include <sstream>
#include <stdexcept>
#include <string_view>

#include "tests/rpc/eventually.h"

namespace kcs::test {
namespace {

constexpr std::string_view kGreeting = "kcsd listens on ";
constexpr std::string_view kFigures = "figures on http://";

std::string address_of(ChildProcess& kcsd) {
  const std::string greeting = kcsd.read_line();
  if (!greeting.starts_with(kGreeting)) throw std::runtime_error("kcsd said \"" + greeting + "\": " + kcsd.errors());
  return greeting.substr(kGreeting.size());
}

}  // namespace

KcsdProcess::KcsdProcess(const std::vector<std::string>& command) : process_(command), address_(address_of(process_)) {}

std::size_t KcsdProcess::status_figure(const std::string& word) const {
  std::ifstream file("/proc/" + std::to_string(process_.pid()) + "/status");
  for (std::string found; file >> found;) {
    std::size_t number = 0;
    if (found == word && file >> number) return number;
  }
  throw std::runtime_error("kcsd is gone: " + process_.errors());
}

double KcsdProcess::cpu_seconds() const {
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

std::string http_address_of(const ChildProcess& kcsd) {
  std::string address;
  const bool found = eventually([&] {
    const std::string log = kcsd.errors();
    const std::size_t begin = log.find(kFigures);
    const std::size_t end = begin == std::string::npos ? begin : log.find("/metrics", begin);
    if (end == std::string::npos) return false;
    address = log.substr(begin + kFigures.size(), end - begin - kFigures.size());
    return true;
  });
  if (!found) throw std::runtime_error("no address of the figures: " + kcsd.errors());
  return address;
}

}  // namespace kcs::test
