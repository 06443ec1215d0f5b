// A run as comma-separated values.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>

#include "client/gateway/trace.h"

namespace kcs::gateway {

// Writes one row a tick: "t,x,y,z,actual_x,actual_y,actual_z,clock" (s, mm; machines with two axes have no z columns):
// the commanded position that is due at that time, what the encoders read then, and when it was given to the drives on
// the computer's monotonic clock, by which it can be compared with what other programs did.
class Recording {
 public:
  // Throws std::system_error if `file` cannot be written. An existing file is replaced.
  Recording(const std::filesystem::path& file, std::size_t axes, double period_s);

  void add(const Tick& tick);

  // Throws std::system_error if not everything could be written. Call once, after the last tick.
  void finish();

 private:
  std::filesystem::path file_;
  std::ofstream out_;
  std::size_t axes_;
  double period_;  // s
  std::uint64_t ticks_ = 0;
};

}  // namespace kcs::gateway
