#include "tests/bench/speed/memory.h"

#include <malloc.h>

#include <fstream>
#include <stdexcept>
#include <string>

namespace kcs::bench {
namespace {

// The highest resident memory since it was last reset, bytes.
std::size_t high_water() {
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);) {
    if (line.starts_with("VmHWM:")) return std::stoul(line.substr(6)) * 1024;
  }
  throw std::runtime_error("/proc/self/status has no VmHWM: memory can be measured on Linux only");
}

}  // namespace

std::size_t allocated() {
  const auto information = mallinfo2();
  return information.uordblks + information.hblkhd;
}

PeakMemory::PeakMemory() {
  malloc_trim(0);                                 // what is free must not hide what is allocated
  std::ofstream("/proc/self/clear_refs") << "5";  // resets VmHWM
  before_ = high_water();
}

std::size_t PeakMemory::most() const { return high_water() - before_; }

}  // namespace kcs::bench
