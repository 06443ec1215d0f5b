#include "tests/system/terminal_process.h"

#include <poll.h>
#include <pty.h>
#include <signal.h>
#include <sys/wait.h>
#include <termios.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <stdexcept>
#include <system_error>

namespace kcs::test {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::chrono::seconds kPatience{60};
constexpr int kMomentMs = 20;

}  // namespace

TerminalProcess::TerminalProcess(const std::vector<std::string>& arguments) {
  std::vector<char*> argv;
  for (const std::string& argument : arguments) argv.push_back(const_cast<char*>(argument.c_str()));
  argv.push_back(nullptr);
  const winsize size{.ws_row = 30, .ws_col = 100, .ws_xpixel = 0, .ws_ypixel = 0};
  pid_ = forkpty(&terminal_, nullptr, nullptr, &size);
  if (pid_ < 0) throw std::system_error(errno, std::generic_category(), "forkpty");
  if (pid_ > 0) return;
  signal(SIGINT, SIG_DFL);  // however the tests were started
  execv(argv[0], argv.data());
  _exit(127);
}

TerminalProcess::~TerminalProcess() {
  if (pid_ > 0) {
    kill(pid_, SIGKILL);
    waitpid(pid_, nullptr, 0);
  }
  close(terminal_);
}

bool TerminalProcess::read_some() {
  pollfd readable{.fd = terminal_, .events = POLLIN, .revents = 0};
  std::array<char, 4096> piece{};
  if (poll(&readable, 1, kMomentMs) != 1) return false;
  const ssize_t size = read(terminal_, piece.data(), piece.size());
  if (size > 0) unseen_.append(piece.data(), static_cast<std::size_t>(size));
  return size > 0;
}

bool TerminalProcess::shows(const std::string& text) {
  for (const auto end = Clock::now() + kPatience; Clock::now() < end;) {
    if (const std::size_t found = unseen_.find(text); found != std::string::npos) {
      unseen_.erase(0, found + text.size());
      return true;
    }
    if (!read_some() && (pid_ < 0 || kill(pid_, 0) != 0)) return false;
  }
  return false;
}

void TerminalProcess::press(char key) const {
  if (write(terminal_, &key, 1) != 1) throw std::system_error(errno, std::generic_category(), "the terminal");
}

bool TerminalProcess::is_as_for_a_shell() const {
  termios settings{};
  if (tcgetattr(terminal_, &settings) != 0) throw std::system_error(errno, std::generic_category(), "tcgetattr");
  return (settings.c_lflag & ICANON) != 0 && (settings.c_lflag & ECHO) != 0;
}

int TerminalProcess::wait() {
  int status = 0;
  for (const auto end = Clock::now() + kPatience; waitpid(pid_, &status, WNOHANG) != pid_; read_some()) {
    if (Clock::now() > end) throw std::runtime_error("the process does not end: " + unseen_);
  }
  pid_ = -1;
  while (read_some()) continue;  // what it said last
  return WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
}

}  // namespace kcs::test
