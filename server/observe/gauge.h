// A number that goes up and down.
#pragma once

#include <atomic>
#include <cstdint>
#include <string_view>

#include "server/observe/exposition.h"

namespace kcs::observe {

// How many of something there are now. Safe for use by many threads at once.
class Gauge {
 public:
  static constexpr std::string_view kType = "gauge";

  void add(std::int64_t count) { value_.fetch_add(count, std::memory_order_relaxed); }
  std::int64_t value() const { return value_.load(std::memory_order_relaxed); }

  void expose(SampleWriter writer) const { writer.add(static_cast<double>(value())); }

  // One more of them, for as long as this lives.
  class Share {
   public:
    explicit Share(Gauge& gauge) : gauge_(gauge) { gauge_.add(1); }
    ~Share() { gauge_.add(-1); }
    Share(const Share&) = delete;
    Share& operator=(const Share&) = delete;

   private:
    Gauge& gauge_;
  };

 private:
  std::atomic<std::int64_t> value_ = 0;
};

}  // namespace kcs::observe
