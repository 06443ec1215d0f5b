#include "client/cli/incoming_program.h"

#include <fcntl.h>
#include <fmt/core.h>
#include <poll.h>
#include <unistd.h>

#include <cerrno>
#include <cstddef>

#include "client/common/file_error.h"

namespace kcs::cli {
namespace {

constexpr std::size_t kPieceBytes = 1 << 16;
constexpr int kLookForStopMs = 50;

}  // namespace

IncomingProgram::IncomingProgram(const std::string& file)
    : file_(file == "-" ? "standard input" : file),
      descriptor_(file == "-" ? STDIN_FILENO : ::open(file.c_str(), O_RDONLY | O_CLOEXEC)),
      piece_(kPieceBytes) {
  if (descriptor_ < 0) {
    throw client::FileError(fmt::format("{}: cannot be read; check its name and its permissions", file_));
  }
}

IncomingProgram::~IncomingProgram() {
  if (descriptor_ != STDIN_FILENO) ::close(descriptor_);
}

std::string_view IncomingProgram::next(const std::stop_token& stop) {
  while (!stop.stop_requested()) {
    pollfd readable{.fd = descriptor_, .events = POLLIN, .revents = 0};
    if (::poll(&readable, 1, kLookForStopMs) == 0) continue;
    const ssize_t size = ::read(descriptor_, piece_.data(), piece_.size());
    if (size >= 0) return {piece_.data(), static_cast<std::size_t>(size)};
    if (errno != EINTR) throw client::FileError(file_ + ": cannot be read to its end");
  }
  return {};
}

}  // namespace kcs::cli
