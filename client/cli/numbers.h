// Numbers as people read them.
#pragma once

#include <cstdint>
#include <string>

namespace kcs::cli {

// 3723.4 → "1:02:03". Whole seconds, rounded to the nearest.
std::string clock_time(double seconds);

// 1234567 → "1,234,567".
std::string with_commas(std::uint64_t number);

// With a fixed number of decimals, and no sign before a zero.
std::string decimal(double number, int decimals);

// About four digits, never an exponent: 0.1234, 12.34, 1234.
std::string short_number(double number);

// "part of whole" as "12.3 %"; "0.0 %" of nothing.
std::string percentage(double part, double whole);

}  // namespace kcs::cli
