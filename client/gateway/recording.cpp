#include "client/gateway/recording.h"

#include <fmt/format.h>

#include <cerrno>
#include <iterator>
#include <string_view>
#include <system_error>

namespace kcs::gateway {

Recording::Recording(const std::filesystem::path& file, std::size_t axes, double period_s)
    : file_(file), out_(file), axes_(axes), period_(period_s) {
  if (!out_) throw std::system_error(errno, std::generic_category(), file.string() + " cannot be opened for writing");
  const std::string_view names =
      axes == 2 ? "t,x,y,actual_x,actual_y,clock\n" : "t,x,y,z,actual_x,actual_y,actual_z,clock\n";
  out_ << names;
}

void Recording::add(const Tick& tick) {
  fmt::memory_buffer row;
  fmt::format_to(std::back_inserter(row), "{:.15g}", static_cast<double>(ticks_) * period_);
  for (const Vector* position : {&tick.commanded_mm, &tick.actual_mm}) {
    for (std::size_t axis = 0; axis < axes_; ++axis) {
      fmt::format_to(std::back_inserter(row), ",{:.15g}", (*position)[static_cast<Eigen::Index>(axis)]);
    }
  }
  fmt::format_to(std::back_inserter(row), ",{:.6f}\n", tick.clock_s);
  out_.write(row.data(), static_cast<std::streamsize>(row.size()));
  ++ticks_;
}

void Recording::finish() {
  if (!out_.flush())
    throw std::system_error(errno, std::generic_category(), file_.string() + " cannot be written to its end");
}

}  // namespace kcs::gateway
