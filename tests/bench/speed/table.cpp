#include "tests/bench/speed/table.h"

#include <fmt/format.h>

#include <cmath>
#include <utility>

namespace kcs::bench {
namespace {

// Three digits that count, with a prefix for thousands before the unit.
std::string with_unit(double value, const std::string& unit) {
  for (const auto& [size, prefix] : {std::pair{1e9, "G"}, {1e6, "M"}, {1e3, "k"}}) {
    if (std::abs(value) >= size) return fmt::format("{:>8.3g} {} {}", value / size, prefix, unit);
  }
  return fmt::format("{:>8.3g} {}", value, unit);
}

}  // namespace

void Table::ReportRuns(const std::vector<Run>& runs) {
  ConsoleReporter::ReportRuns(runs);
  for (const Run& run : runs) counters_[run.run_name.function_name] = run.counters;
}

const benchmark::Counter* Table::find(const std::string& benchmark, const std::string& counter) const {
  const auto run = counters_.find(benchmark);
  if (run == counters_.end()) return nullptr;
  const auto found = run->second.find(counter);
  return found == run->second.end() ? nullptr : &found->second;
}

void Table::print() const {
  constexpr auto kLine = "{:<40}{:<33}{:<20}{:>8}  {}\n";
  fmt::print("\n");
  fmt::print(kLine, "measured", "", "against", "ratio", "aim");
  std::string previous;
  for (const Row& row : rows_) {
    const benchmark::Counter* const value = find(row.benchmark, row.counter);
    if (value == nullptr) continue;
    const benchmark::Counter* const reference = find(row.reference, row.counter);
    const std::string ratio = reference == nullptr ? "" : fmt::format("{:.3g}", value->value / reference->value);
    const std::string figure = with_unit(*value, row.counter);
    const bool repeated = previous == row.what + figure;
    fmt::print(kLine, repeated ? "" : row.what, repeated ? "" : figure, row.against, ratio, row.aim);
    previous = row.what + figure;
  }
}

}  // namespace kcs::bench
