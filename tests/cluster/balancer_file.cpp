#include "tests/cluster/balancer_file.h"

#include <fstream>
#include <sstream>
#include <stdexcept>

namespace kcs::test {

std::string shipped_balancer(const std::string& folder) {
  std::ostringstream shipped;
  shipped << std::ifstream(KCS_SOURCE "/deploy/" + folder + "/haproxy.cfg").rdbuf();
  return shipped.str();
}

void replace(std::string& text, const std::string& from, const std::string& to) {
  std::size_t at = text.find(from);
  if (at == std::string::npos) throw std::runtime_error("haproxy.cfg has no \"" + from + "\"");
  for (; at != std::string::npos; at = text.find(from, at + to.size())) text.replace(at, from.size(), to);
}

}  // namespace kcs::test
