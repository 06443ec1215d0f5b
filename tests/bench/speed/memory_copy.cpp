#include <cstring>
#include <vector>

#include "tests/bench/speed/benchmarks.h"

namespace kcs::bench {

benchmark::Counter rate(double per_iteration) {
  return benchmark::Counter(per_iteration, benchmark::Counter::kIsIterationInvariantRate);
}

void add_memory_copy(const std::string& name, std::size_t bytes) {
  benchmark::RegisterBenchmark(name.c_str(), [bytes](benchmark::State& state) {
    std::vector<char> from(bytes, 'x'), to(bytes);
    while (state.KeepRunning()) {
      std::memcpy(to.data(), from.data(), bytes);
      benchmark::DoNotOptimize(to.data());
      benchmark::ClobberMemory();
    }
    state.counters["B/s"] = rate(static_cast<double>(bytes));
  });
}

}  // namespace kcs::bench
