// What a running server says of itself under /metrics.
#pragma once

#include <map>
#include <string>

namespace kcs::observe::test {

// Every series' value, as in read_exposition. Throws std::runtime_error if the server at HOST:PORT does not answer.
std::map<std::string, double> read_figures(const std::string& http_address);

}  // namespace kcs::observe::test
