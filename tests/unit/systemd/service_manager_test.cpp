#include "server/systemd/service_manager.h"

#include <gtest/gtest.h>
#include <stdlib.h>
#include <sys/socket.h>
#include <sys/time.h>
#include <sys/un.h>
#include <unistd.h>

#include <array>
#include <cstring>
#include <stdexcept>
#include <string>

#include "server/systemd/inherited_sockets.h"

namespace kcs::systemd {
namespace {

// Listens as systemd does.
class Manager {
 public:
  Manager() : path_(::testing::TempDir() + "kcs-notify-" + std::to_string(getpid())) {
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    std::strncpy(address.sun_path, path_.c_str(), sizeof(address.sun_path) - 1);
    EXPECT_EQ(bind(socket_, reinterpret_cast<const sockaddr*>(&address), sizeof(address)), 0);
    const timeval patience{.tv_sec = 10, .tv_usec = 0};
    setsockopt(socket_, SOL_SOCKET, SO_RCVTIMEO, &patience, sizeof(patience));
    setenv("NOTIFY_SOCKET", path_.c_str(), 1);
  }
  ~Manager() {
    unsetenv("NOTIFY_SOCKET");
    close(socket_);
    unlink(path_.c_str());
  }
  Manager(const Manager&) = delete;
  Manager& operator=(const Manager&) = delete;

  std::string receive() const {
    std::array<char, 512> bytes{};
    const ssize_t size = recv(socket_, bytes.data(), bytes.size(), 0);
    return size < 0 ? "nothing came" : std::string(bytes.data(), static_cast<std::size_t>(size));
  }

 private:
  const std::string path_;
  const int socket_ = socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC, 0);
};

TEST(ServiceManager, IsToldHowTheServiceFares) {
  const Manager manager;
  tell_ready("serves on 127.0.0.1:50551");
  EXPECT_EQ(manager.receive(), "READY=1\nSTATUS=serves on 127.0.0.1:50551");
  tell_alive();
  EXPECT_EQ(manager.receive(), "WATCHDOG=1");
  tell_stopping("lets running requests finish");
  EXPECT_EQ(manager.receive(), "STOPPING=1\nSTATUS=lets running requests finish");
}

TEST(ServiceManager, NeedNotBeThere) {
  unsetenv("NOTIFY_SOCKET");
  tell_ready("");
  setenv("NOTIFY_SOCKET", "/nowhere/notify", 1);
  tell_ready("");
  unsetenv("NOTIFY_SOCKET");
}

TEST(ServiceManager, WatchesOnlyTheProcessThatItMeans) {
  EXPECT_FALSE(watchdog_period());
  setenv("WATCHDOG_USEC", "3000000", 1);
  EXPECT_EQ(watchdog_period(), std::chrono::seconds(3));
  setenv("WATCHDOG_PID", "1", 1);
  EXPECT_FALSE(watchdog_period());
  unsetenv("WATCHDOG_PID");
  unsetenv("WATCHDOG_USEC");
}

TEST(InheritedSockets, AreMissedWithTheRemedy) {
  try {
    inherited_sockets();
    ADD_FAILURE() << "found sockets";
  } catch (const std::runtime_error& refused) {
    EXPECT_NE(std::string(refused.what()).find(".socket"), std::string::npos) << refused.what();
  }
}

}  // namespace
}  // namespace kcs::systemd
