#include "server/net/address.h"

#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <netinet/in.h>

#include <string>

namespace kcs::net {
namespace {

TEST(Address, IsAHostAndAPort) {
  for (const std::string text : {"127.0.0.1:0", "localhost:9551", "[::1]:65535", "a.example:80"}) {
    const auto address = parse_host_port(text);
    ASSERT_TRUE(address) << text;
    EXPECT_EQ(to_string(*address), text);
  }
  EXPECT_EQ(parse_host_port("[::1]:80")->host, "::1");
}

TEST(Address, IsNothingElse) {
  for (const std::string text : {"", "localhost", ":80", "localhost:", "localhost:http", "a:65536", "a:-1", "a:+1",
                                 "a: 1", "a:1x", "a:99999999999999999999"}) {
    EXPECT_FALSE(parse_host_port(text)) << text;
  }
}

TEST(Address, OfASocketIsWrittenInNumbers) {
  sockaddr_storage storage{};
  auto& six = reinterpret_cast<sockaddr_in6&>(storage);
  six.sin6_family = AF_INET6;
  six.sin6_addr = in6addr_loopback;
  six.sin6_port = htons(80);
  EXPECT_EQ(to_string(host_port_of(storage).value()), "[::1]:80");
  storage = {};
  storage.ss_family = AF_UNIX;
  EXPECT_FALSE(host_port_of(storage));
}

}  // namespace
}  // namespace kcs::net
