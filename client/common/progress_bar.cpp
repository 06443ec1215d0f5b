#include "client/common/progress_bar.h"

#include <fmt/core.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <utility>

namespace kcs::client {
namespace {

constexpr auto kTimeBetweenDrawings = std::chrono::milliseconds(100);

std::size_t terminal_width() {
  winsize size{};
  return ::ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0 ? size.ws_col : 80;
}

}  // namespace

std::string bar(double share, std::size_t length) {
  const auto filled = static_cast<std::size_t>(std::clamp(share, 0.0, 1.0) * static_cast<double>(length));
  return fmt::format("[{}{}]", std::string(filled, '='), std::string(length - filled, ' '));
}

std::string progress_line(const std::string& what, std::uint64_t done, std::uint64_t total, std::size_t width) {
  constexpr std::size_t kWidest = 60;
  const double share = total == 0 ? 1 : std::min(1.0, static_cast<double>(done) / static_cast<double>(total));
  std::string percent = fmt::format("{:3.0f} %", 100 * share);
  const std::size_t around = what.size() + percent.size() + 4;  // a blank on either side, and the brackets
  if (width < around + 3) return percent;
  const std::size_t length = std::min(width - around, kWidest);
  return fmt::format("{} {} {}", what, bar(share, length), percent);
}

ProgressBar::ProgressBar(std::string what) : what_(std::move(what)), on_terminal_(::isatty(STDERR_FILENO) == 1) {}

ProgressBar::~ProgressBar() {
  if (on_terminal_) std::fputs("\r\x1b[K", stderr);
}

void ProgressBar::update(std::uint64_t done, std::uint64_t total) {
  const auto now = std::chrono::steady_clock::now();
  if (!on_terminal_ || now < next_drawing_) return;
  next_drawing_ = now + kTimeBetweenDrawings;
  std::fputs(("\r" + progress_line(what_, done, total, terminal_width() - 1)).c_str(), stderr);
}

}  // namespace kcs::client
