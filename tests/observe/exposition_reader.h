// Reads Prometheus's text format as strictly as its description has it.
#pragma once

#include <map>
#include <string>

namespace kcs::observe::test {

// The samples, each under its name and labels as they are written. Every departure from the format fails the test:
// lines that are none, a sample before its TYPE or outside its metric's group, one that comes twice, a histogram whose
// buckets do not grow up to its count.
std::map<std::string, double> read_exposition(const std::string& text);

}  // namespace kcs::observe::test
