// A number that only grows.
#pragma once

#include <atomic>
#include <cstdint>
#include <string_view>

#include "server/observe/exposition.h"

namespace kcs::observe {

// Safe for use by many threads at once; add() costs one atomic addition.
class Counter {
 public:
  static constexpr std::string_view kType = "counter";

  void add(std::uint64_t count = 1) { value_.fetch_add(count, std::memory_order_relaxed); }
  std::uint64_t value() const { return value_.load(std::memory_order_relaxed); }

  void expose(SampleWriter writer) const { writer.add(value()); }

 private:
  std::atomic<std::uint64_t> value_ = 0;
};

}  // namespace kcs::observe
