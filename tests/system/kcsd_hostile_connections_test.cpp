// Connections that speak HTTP/2 badly, slowly or not at all.
#include <signal.h>

#include <deque>
#include <random>
#include <string>
#include <thread>

#include "tests/system/hostile_clients.h"
#include "tests/system/raw_connection.h"

namespace kcs::test {
namespace {

constexpr std::string_view kPreface = "PRI * HTTP/2.0\r\n\r\nSM\r\n\r\n";
constexpr char kHeaders = 1, kSettings = 4, kContinuation = 9;

// A frame of HTTP/2 without any flag: of headers, one that is to be continued.
std::string frame(char type, std::uint8_t stream, const std::string& content) {
  std::string bytes;
  for (const int shift : {16, 8, 0}) bytes += static_cast<char>(content.size() >> shift);
  bytes += type;
  bytes += std::string(4, '\0');
  bytes += static_cast<char>(stream);
  return bytes + content;
}

// A header that is taken as it is, not noted for later ones.
std::string header(std::uint64_t number) {
  const std::string name = "x-" + std::to_string(number), value(100, 'x');
  return std::string(1, '\0') + static_cast<char>(name.size()) + name + static_cast<char>(value.size()) + value;
}

using HostileConnections = HostileClients;

TEST_F(HostileConnections, ThatSayHelloByteByByteAreClosed) {
  std::deque<RawConnection> connections;
  for (int i = 0; i < 100; ++i) connections.emplace_back(kcsd_.address());
  for (const char byte : kPreface.substr(0, kPreface.size() - 1)) {
    for (RawConnection& connection : connections) connection.send({&byte, 1});
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  EXPECT_TRUE(is_served());
  for (RawConnection& connection : connections) EXPECT_TRUE(connection.is_closed_within(kDeadline));
}

TEST_F(HostileConnections, ThatSayNothingAreClosed) {
  std::deque<RawConnection> connections;
  for (int i = 0; i < 100; ++i) connections.emplace_back(kcsd_.address());
  EXPECT_TRUE(is_served());
  for (RawConnection& connection : connections) EXPECT_TRUE(connection.is_closed_within(kDeadline));
}

// gRPC 1.51 keeps such headers whole (CVE-2023-33953, mended in 1.53.2): as long as the connection, and no longer.
TEST_F(HostileConnections, WhoseHeadersDoNotEndHoldUpNobodyAndLeaveNothingBehind) {
  constexpr std::uint64_t kBytesPerRound = 20'000'000;
  const auto flood = [this] {
    std::deque<RawConnection> connections;
    for (int i = 0; i < 4; ++i) {
      connections.emplace_back(kcsd_.address());
      connections.back().send(std::string(kPreface) + frame(kSettings, 0, "") + frame(kHeaders, 1, header(0)));
    }
    std::string more;
    for (std::uint64_t number = 1; number <= 100; ++number) more += header(number);
    const std::string continuation = frame(kContinuation, 1, more);
    for (std::uint64_t sent = 0; sent < kBytesPerRound; sent += connections.size() * continuation.size()) {
      for (RawConnection& connection : connections) connection.send(continuation);
    }
    EXPECT_TRUE(is_served());
  };
  flood();
  const std::size_t before = kcsd_.status_figure("VmHWM:");
  for (int round = 0; round < 15; ++round) flood();
  // Connections of a few rounds may be there at the same time, until kcsd sees that they were closed; not all of them.
  EXPECT_LT(kcsd_.status_figure("VmHWM:"), before + 6 * kBytesPerRound / 1000);
}

TEST_F(HostileConnections, ThatSendGarbageAreNoTrouble) {
  std::mt19937 random(51);
  for (int i = 0; i < 300; ++i) {
    RawConnection connection(kcsd_.address());
    std::string bytes;
    if (i % 3 > 0) bytes = kPreface;
    if (i % 3 > 1) bytes += frame(kSettings, 0, "") + frame(static_cast<char>(random() % 16), random() % 4, "abc");
    for (std::uint64_t size = random() % 3000; size > 0; --size) bytes += static_cast<char>(random());
    connection.send(bytes);
    EXPECT_TRUE(i % 10 != 0 || is_served());
  }
}

TEST_F(HostileConnections, ThatComeAndGoLeaveNothingBehind) {
  const std::size_t before = kcsd_.status_figure("FDSize:");
  for (int i = 0; i < 2000; ++i) RawConnection(kcsd_.address()).send(kPreface);
  EXPECT_TRUE(is_served());
  EXPECT_LE(kcsd_.status_figure("FDSize:"), std::max<std::size_t>(before, 4096));
}

}  // namespace
}  // namespace kcs::test
