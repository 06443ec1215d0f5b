#include "server/systemd/service_manager.h"

#include <gtest/gtest.h>
#include <stdlib.h>

#include <chrono>
#include <stdexcept>
#include <string>

#include "server/systemd/inherited_sockets.h"
#include "tests/systemd/notify_socket.h"

namespace kcs::systemd {
namespace {

TEST(ServiceManager, IsToldHowTheServiceFares) {
  const test::NotifySocket manager;
  setenv("NOTIFY_SOCKET", manager.path().c_str(), 1);
  tell_ready("serves on 127.0.0.1:50551");
  EXPECT_EQ(manager.receive(), "READY=1\nSTATUS=serves on 127.0.0.1:50551");
  tell_alive();
  EXPECT_EQ(manager.receive(), "WATCHDOG=1");
  tell_stopping("lets running requests finish");
  EXPECT_EQ(manager.receive(), "STOPPING=1\nSTATUS=lets running requests finish");
  unsetenv("NOTIFY_SOCKET");
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
