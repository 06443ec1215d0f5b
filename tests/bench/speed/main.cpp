// How fast kcs is. With G-code files: how fast it reads and plans those.
#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <exception>

#include "tests/bench/speed/benchmarks.h"

int main(int argc, char** argv) {
  using namespace kcs::bench;
  benchmark::Initialize(&argc, argv);
  spdlog::set_level(spdlog::level::warn);  // the server's log
  try {
    Table table;
    const std::span<char*> files(argv + 1, static_cast<std::size_t>(argc - 1));
    if (files.empty()) {
      add_planning(table);
      add_scaling(table);
      add_reading(table);
      add_sampling(table);
      add_streaming(table);
    } else {
      add_programs(table, files);
    }
    benchmark::RunSpecifiedBenchmarks(&table);
    table.print();
    return 0;
  } catch (const std::exception& failure) {
    fmt::print(stderr, "bench: {}\n", failure.what());
    return 1;
  }
}
