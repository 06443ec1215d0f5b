// What ./run bench ends with: figures beside the figures that they are to be compared with, because machines differ.
#pragma once

#include <benchmark/benchmark.h>

#include <map>
#include <string>
#include <vector>

namespace kcs::bench {

// Shows the benchmarks as they run, and remembers their counters.
class Table : public benchmark::ConsoleReporter {
 public:
  struct Row {
    std::string what;
    std::string counter;    // a counter of both benchmarks, whose name is its unit
    std::string benchmark;  // its name
    std::string against;    // in words; empty: nothing
    std::string reference;  // the name of the benchmark to be compared with
    std::string aim;        // what is aimed at, in words; empty: nothing
  };

  Table() : ConsoleReporter(OO_None) {}

  void add(const Row& row) { rows_.push_back(row); }

  // After the benchmarks; leaves out the rows whose benchmark did not run.
  void print() const;

  void ReportRuns(const std::vector<Run>& runs) override;

 private:
  const benchmark::Counter* find(const std::string& benchmark, const std::string& counter) const;

  std::vector<Row> rows_;
  std::map<std::string, benchmark::UserCounters> counters_;
};

}  // namespace kcs::bench
