// How far a long task has come, for a person who waits.
#pragma once

#include <chrono>
#include <cstdint>
#include <string>

namespace kcs::client {

// "[=====     ]": of `length` columns between the brackets the share (cut to 0 … 1) that is filled.
std::string bar(double share, std::size_t length);

// The bar in one line of at most `width` columns: "setpoints [======>      ]  52 %".
std::string progress_line(const std::string& what, std::uint64_t done, std::uint64_t total, std::size_t width);

// Draws a bar on standard error if that is a terminal, and nothing otherwise; wipes it out when it goes.
class ProgressBar {
 public:
  explicit ProgressBar(std::string what);
  ~ProgressBar();
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  void update(std::uint64_t done, std::uint64_t total);

 private:
  std::string what_;
  bool on_terminal_;
  std::chrono::steady_clock::time_point next_drawing_;
};

}  // namespace kcs::client
