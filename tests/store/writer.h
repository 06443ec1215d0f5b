// What the process store_writer does, and what its test expects of it.
#pragma once

#include <cstdint>
#include <string>

#include "tests/store/store_test.h"

namespace kcs::store {

// The request of each number: now and then a large one, in several rows.
inline std::string written_bytes(std::uint64_t number) {
  const std::size_t size = number % 10 == 9 ? 5'000'000 : 1 + number * 7919 % 100'000;
  return some_bytes(number, size);
}

inline std::string written_plan(std::uint64_t number) { return "plan " + std::to_string(number); }

// Of each ten numbers some are finished at once, some later, some never, and some are removed in the end.
inline bool is_finished_at_once(std::uint64_t number) { return number % 5 == 0; }
inline bool is_finished_later(std::uint64_t number) { return number % 5 == 1 || number % 5 == 2; }
inline bool is_removed(std::uint64_t number) { return number % 5 == 2; }

}  // namespace kcs::store
