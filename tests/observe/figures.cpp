#include "tests/observe/figures.h"

#include <httplib.h>

#include <chrono>
#include <stdexcept>

#include "tests/observe/exposition_reader.h"

namespace kcs::observe::test {

std::map<std::string, double> read_figures(const std::string& http_address) {
  httplib::Client client("http://" + http_address);
  client.set_read_timeout(std::chrono::seconds(20));
  const auto answer = client.Get("/metrics");
  if (!answer) throw std::runtime_error("no figures: " + to_string(answer.error()));
  return read_exposition(answer->body);
}

}  // namespace kcs::observe::test
