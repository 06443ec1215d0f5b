// Connections that end in time.
#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <cstdint>
#include <string>

#include "tests/service/test_server.h"

namespace kcs::service::test {
namespace {

TEST(Connections, ThatSayNothingAreClosed) {
  const TestServer server({.connections = {.handshake = std::chrono::milliseconds(200)}});
  sockaddr_in target{};
  target.sin_family = AF_INET;
  target.sin_port =
      htons(static_cast<std::uint16_t>(std::stoi(server.address().substr(server.address().rfind(':') + 1))));
  target.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  const int connection = socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
  const timeval patience{.tv_sec = kDeadline.count(), .tv_usec = 0};
  setsockopt(connection, SOL_SOCKET, SO_RCVTIMEO, &patience, sizeof patience);
  ASSERT_EQ(connect(connection, reinterpret_cast<const sockaddr*>(&target), sizeof target), 0);
  std::array<char, 1024> bytes{};
  ssize_t received = 0;
  while ((received = recv(connection, bytes.data(), bytes.size(), 0)) > 0) continue;  // the server's own greeting
  EXPECT_TRUE(received == 0 || errno == ECONNRESET) << errno;
  close(connection);
}

class OldConnections : public ::testing::Test {
 protected:
  // Reads a stream of two billion setpoints until it ends, or gives up after `patience`. Returns how it ended.
  static grpc::Status stream(TestServer& server, std::chrono::milliseconds patience) {
    v1::PlanOptions slow = options();
    slow.set_feed_mm_s(0.01);
    const std::string name = server.create({request(slow), request(path({0, 0, 100, 0, 100, 100}))}).message.name();
    Call call;
    const auto reader = server.stub().StreamSetpoints(&call, setpoints(name, 1e-5));
    const auto end = std::chrono::steady_clock::now() + patience;
    v1::SetpointBatch batch;
    while (reader->Read(&batch)) {
      if (std::chrono::steady_clock::now() > end) call.TryCancel();
    }
    return reader->Finish();
  }

  static constexpr std::chrono::milliseconds kAge{300};
};

TEST_F(OldConnections, LetTheirCallsGoOn) {
  TestServer server({.connections = {.longest_age = kAge}});
  EXPECT_EQ(stream(server, 4 * kAge).error_code(), grpc::StatusCode::CANCELLED) << "by this client";
  EXPECT_EQ(server.get("plans/none").status.error_code(), grpc::StatusCode::NOT_FOUND);
}

TEST_F(OldConnections, EndTheirCallsAfterTheGrace) {
  TestServer server({.connections = {.longest_age = kAge, .age_grace = std::chrono::milliseconds(100)}});
  EXPECT_EQ(stream(server, kDeadline / 2).error_code(), grpc::StatusCode::UNAVAILABLE);
  EXPECT_EQ(server.get("plans/none").status.error_code(), grpc::StatusCode::NOT_FOUND);
}

}  // namespace
}  // namespace kcs::service::test
