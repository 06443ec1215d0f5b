#include "client/cli/terminal.h"

#include <fmt/core.h>
#include <poll.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdio>

#include "client/common/file_error.h"

namespace kcs::cli {
namespace {

// Control sequences that every terminal of today knows.
constexpr const char* kHideCursor = "\x1b[?25l";
constexpr const char* kShowCursor = "\x1b[?25h";
constexpr const char* kCutLines = "\x1b[?7l";  // at the right edge, instead of going on below
constexpr const char* kWrapLines = "\x1b[?7h";
constexpr const char* kWipeToEndOfLine = "\x1b[K";
constexpr const char* kWipeToEndOfScreen = "\x1b[J";
constexpr char kEscape = '\x1b';

void write(const std::string& text) {
  std::fputs(text.c_str(), stdout);
  std::fflush(stdout);
}

}  // namespace

bool Terminal::is_there() { return ::isatty(STDIN_FILENO) == 1 && ::isatty(STDOUT_FILENO) == 1; }

Terminal::Terminal() : restore_at_last_([this] { restore(); }) {}

Terminal::~Terminal() { restore(); }

void Terminal::take() {
  phase_ = Phase::kTaken;
  ::tcgetattr(STDIN_FILENO, &before_);
  termios keys = before_;
  keys.c_lflag &= ~static_cast<tcflag_t>(ICANON | ECHO);
  keys.c_cc[VSUSP] = _POSIX_VDISABLE;
  keys.c_cc[VMIN] = 1;
  keys.c_cc[VTIME] = 0;
  ::tcsetattr(STDIN_FILENO, TCSANOW, &keys);
  write(kHideCursor);
}

void Terminal::restore() {
  const std::lock_guard lock(mutex_);
  if (phase_ == Phase::kTaken) {
    write(kShowCursor);
    ::tcsetattr(STDIN_FILENO, TCSANOW, &before_);
  }
  phase_ = Phase::kRestored;
}

void Terminal::draw(const std::vector<std::string>& lines) {
  const std::lock_guard lock(mutex_);
  if (phase_ == Phase::kRestored || lines == drawn_) return;
  if (phase_ == Phase::kUntouched) take();
  std::string text = drawn_.empty() ? "" : fmt::format("\r\x1b[{}A", drawn_.size());
  text += kCutLines;
  for (const std::string& line : lines) text += line + kWipeToEndOfLine + "\r\n";
  drawn_ = lines;
  write(text + kWipeToEndOfScreen + kWrapLines);
}

std::string Terminal::read_keys(std::chrono::milliseconds patience) {
  pollfd readable{.fd = STDIN_FILENO, .events = POLLIN, .revents = 0};
  if (::poll(&readable, 1, static_cast<int>(patience.count())) <= 0) return "";
  std::array<char, 64> keys{};
  const ssize_t size = ::read(STDIN_FILENO, keys.data(), keys.size());
  if (size < 0 && errno == EINTR) return "";
  if (size <= 0) throw client::FileError("the terminal has gone; the run goes on without it");
  return keys[0] == kEscape ? "" : std::string(keys.data(), static_cast<std::size_t>(size));
}

}  // namespace kcs::cli
