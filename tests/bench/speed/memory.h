// How much memory this process uses.
#pragma once

#include <cstddef>

namespace kcs::bench {

// Bytes that are allocated on the heap now.
std::size_t allocated();

// Memory of the process that is really there, since construction.
class PeakMemory {
 public:
  PeakMemory();
  // The most, in bytes, above what there was at construction. Throws std::runtime_error if the kernel does not tell.
  std::size_t most() const;

 private:
  std::size_t before_;
};

}  // namespace kcs::bench
