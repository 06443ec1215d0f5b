#include "server/observe/http_endpoint.h"

#include <arpa/inet.h>
#include <fmt/core.h>
#include <gtest/gtest.h>
#include <httplib.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <sys/time.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstdint>
#include <memory>
#include <random>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "server/net/address.h"
#include "server/version/version.h"

namespace kcs::observe {
namespace {

constexpr std::chrono::seconds kDeadline{60};

// A client of no manners.
class RawClient {
 public:
  explicit RawClient(const std::string& server) {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(static_cast<std::uint16_t>(net::parse_host_port(server).value().port));
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    const timeval patience{.tv_sec = kDeadline.count(), .tv_usec = 0};
    setsockopt(socket_, SOL_SOCKET, SO_RCVTIMEO, &patience, sizeof(patience));
    EXPECT_EQ(connect(socket_, reinterpret_cast<const sockaddr*>(&address), sizeof(address)), 0);
  }
  ~RawClient() { close(socket_); }
  RawClient(const RawClient&) = delete;
  RawClient& operator=(const RawClient&) = delete;

  // False if the server has closed the connection.
  bool send(const std::string& bytes) const {
    return ::send(socket_, bytes.data(), bytes.size(), MSG_NOSIGNAL) == static_cast<ssize_t>(bytes.size());
  }

  // Everything up to the connection's end.
  std::string receive() const {
    std::string all;
    char byte = 0;
    while (recv(socket_, &byte, 1, 0) == 1) all.push_back(byte);
    EXPECT_NE(errno, EAGAIN) << "the server does not close the connection";
    return all;
  }

 private:
  const int socket_ = socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
};

class HttpEndpointTest : public ::testing::Test {
 protected:
  httplib::Result get(const std::string& path) {
    const auto address = net::parse_host_port(endpoint_->address()).value();
    httplib::Client client(address.host, address.port);
    client.set_read_timeout(kDeadline);
    return client.Get(path);
  }

  void expect_alive() {
    const auto answer = get("/healthz");
    ASSERT_TRUE(answer) << to_string(answer.error());
    EXPECT_EQ(answer->status, 200);
  }

  Registry registry_;
  Readiness readiness_;
  std::unique_ptr<HttpEndpoint> endpoint_ = std::make_unique<HttpEndpoint>("127.0.0.1:0", registry_, readiness_, Log());
};

TEST_F(HttpEndpointTest, GivesTheFiguresAsPrometheusReadsThem) {
  registry_.counter({"kcs_parts_total", "Parts made."}).add(3);
  const auto answer = get("/metrics");
  ASSERT_TRUE(answer);
  EXPECT_EQ(answer->status, 200);
  EXPECT_EQ(answer->get_header_value("Content-Type"), "text/plain; version=0.0.4; charset=utf-8");
  EXPECT_EQ(answer->body, registry_.exposition());
}

TEST_F(HttpEndpointTest, TellsThatTheProcessLivesAndWhichOneItIs) {
  const auto answer = get("/healthz");
  ASSERT_TRUE(answer) << to_string(answer.error());
  EXPECT_EQ(answer->status, 200);
  EXPECT_EQ(answer->body, fmt::format("alive\nversion {}\nbuild {}\n", version(), build()));
}

TEST(Version, IsOfThisReleaseAndOfSomethingThatCanBeFoundAgain) {
  EXPECT_EQ(std::count(version().begin(), version().end(), '.'), 2);
  EXPECT_FALSE(build().empty());
  EXPECT_EQ(version_and_build(), fmt::format("{} (build {})", version(), build()));
}

TEST_F(HttpEndpointTest, TellsWhetherTheServerIsReadyAndWhyNot) {
  readiness_.set_not_ready("the store is away");
  const auto away = get("/readyz");
  ASSERT_TRUE(away);
  EXPECT_EQ(away->status, 503);
  EXPECT_EQ(away->body, "not ready: the store is away\n");
  readiness_.set_ready();
  const auto there = get("/readyz");
  ASSERT_TRUE(there);
  EXPECT_EQ(there->status, 200);
  EXPECT_EQ(there->body, "ready\n");
}

TEST_F(HttpEndpointTest, HasNothingElse) {
  for (const std::string path : {"/", "/metrics/", "/healthz2", "/../../etc/passwd", "/%2e%2e/etc/passwd"}) {
    const auto answer = get(path);
    ASSERT_TRUE(answer) << path;
    EXPECT_EQ(answer->status, 404) << path;
  }
}

TEST_F(HttpEndpointTest, PortInUseIsRefusedWithTheRemedy) {
  try {
    const HttpEndpoint second(endpoint_->address(), registry_, readiness_, Log());
    ADD_FAILURE() << "listens on a port that is in use";
  } catch (const std::runtime_error& refused) {
    EXPECT_NE(std::string(refused.what()).find(endpoint_->address()), std::string::npos) << refused.what();
    EXPECT_NE(std::string(refused.what()).find("another program"), std::string::npos) << refused.what();
  }
}

TEST_F(HttpEndpointTest, AddressWithoutAPortIsRefused) {
  for (const std::string address : {"localhost", "127.0.0.1:", "unix:/tmp/x"}) {
    EXPECT_THROW(HttpEndpoint(address, registry_, readiness_, Log()), std::runtime_error) << address;
  }
}

TEST_F(HttpEndpointTest, SlowClientsAreSentAwayAndOthersServed) {
  std::vector<std::unique_ptr<RawClient>> clients;
  for (int i = 0; i < 12; ++i) clients.push_back(std::make_unique<RawClient>(endpoint_->address()));
  const RawClient& slow = *clients.front();
  ASSERT_TRUE(slow.send("GET /healthz HTTP/1.1\r\nX: "));
  // A byte now and then: no pause is long, but the request never ends.
  const auto began = std::chrono::steady_clock::now();
  while (slow.send("x") && std::chrono::steady_clock::now() < began + kDeadline) {
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
  }
  EXPECT_LT(std::chrono::steady_clock::now(), began + kDeadline) << "a slow client keeps its place";
  expect_alive();
}

TEST_F(HttpEndpointTest, RequestsWithoutEndAreCutOff) {
  for (const std::string start : {"GET /", "GET /metrics HTTP/1.1\r\n",
                                  "POST /metrics HTTP/1.1\r\nTransfer-Encoding: "
                                  "chunked\r\n\r\n"}) {
    const RawClient client(endpoint_->address());
    std::size_t sent = 0;
    client.send(start);
    while (client.send(start.starts_with("POST") ? "1\r\nx\r\n" : "A: bbbbbbbbbbbb\r\n") && sent < (64U << 20)) ++sent;
    EXPECT_LT(sent, 64U << 20) << start;
  }
  expect_alive();
}

TEST_F(HttpEndpointTest, GarbageDoesNotDisturbIt) {
  std::string many_ranges = "GET /metrics HTTP/1.1\r\nRange: bytes=0-0";
  while (many_ranges.size() < 8000) many_ranges += ",0-0";
  std::vector<std::string> requests = {many_ranges + "\r\n\r\n",
                                       "GET /metrics HTTP/1.1\r\nContent-Length: 99999999999999999999\r\n\r\n",
                                       "GET /metrics HTTP/1.1\r\nContent-Length: -1\r\n\r\n",
                                       "GET /%zz%00%ff?%=&&=%u12 HTTP/1.1\r\n\r\n",
                                       "GET /metrics HTTP/1.1\r\nExpect: 100-continue\r\n\r\n",
                                       "GET /metrics HTTP/9.9\r\n\r\n",
                                       "GET  HTTP/1.1\r\n\r\n",
                                       "POST /metrics HTTP/1.1\r\nContent-Type: multipart/form-data; boundary=\r\n"
                                       "Content-Length: 4\r\n\r\nabcd",
                                       "PRI * HTTP/2.0\r\n\r\nSM\r\n\r\n",
                                       "\r\n\r\n",
                                       std::string(4000, '\0')};
  std::mt19937 random(7);
  for (int i = 0; i < 20; ++i) {
    std::string bytes;
    for (int k = 0; k < 500; ++k) bytes.push_back(static_cast<char>(random()));
    requests.push_back(bytes + "\r\n\r\n");
  }
  for (const std::string& request : requests) {
    const RawClient client(endpoint_->address());
    client.send(request);
  }
  expect_alive();
}

TEST_F(HttpEndpointTest, EndsThoughClientsAreConnected) {
  const RawClient silent(endpoint_->address());
  expect_alive();
  const auto began = std::chrono::steady_clock::now();
  endpoint_.reset();
  EXPECT_LT(std::chrono::steady_clock::now() - began, std::chrono::seconds(20));
  EXPECT_EQ(silent.receive(), "");
}

}  // namespace
}  // namespace kcs::observe
