// The socket on which systemd hears from its services.
#pragma once

#include <gtest/gtest.h>
#include <sys/socket.h>
#include <sys/time.h>
#include <sys/un.h>
#include <unistd.h>

#include <array>
#include <cstring>
#include <string>

namespace kcs::test {

class NotifySocket {
 public:
  NotifySocket() : path_(::testing::TempDir() + "kcs-notify-" + std::to_string(getpid())) {
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    std::strncpy(address.sun_path, path_.c_str(), sizeof(address.sun_path) - 1);
    EXPECT_EQ(bind(socket_, reinterpret_cast<const sockaddr*>(&address), sizeof(address)), 0);
    const timeval patience{.tv_sec = 60, .tv_usec = 0};
    setsockopt(socket_, SOL_SOCKET, SO_RCVTIMEO, &patience, sizeof(patience));
  }
  ~NotifySocket() {
    close(socket_);
    unlink(path_.c_str());
  }
  NotifySocket(const NotifySocket&) = delete;
  NotifySocket& operator=(const NotifySocket&) = delete;

  // What NOTIFY_SOCKET is to be.
  const std::string& path() const { return path_; }

  // The next message; waits for it for up to a minute.
  std::string receive() const {
    std::array<char, 512> bytes{};
    const ssize_t size = recv(socket_, bytes.data(), bytes.size(), 0);
    return size < 0 ? "nothing came" : std::string(bytes.data(), static_cast<std::size_t>(size));
  }

 private:
  const std::string path_;
  const int socket_ = socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC, 0);
};

}  // namespace kcs::test
