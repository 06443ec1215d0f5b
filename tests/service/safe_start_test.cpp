// Where a server listens, and where it refuses to.
#include <gtest/gtest.h>

#include <stdexcept>
#include <string>

#include "server/service/listen_address.h"
#include "server/service/security.h"

namespace kcs::service {
namespace {

std::string refusal(const SecuritySettings& settings, const std::string& listen) {
  try {
    require_safe(settings, listen);
    return "";
  } catch (const std::runtime_error& refused) {
    return refused.what();
  }
}

SecuritySettings with_tls() { return {.tls = {.certificate = "server.pem", .key = "key.pem"}}; }

TEST(SocketAddresses, TellThisMachineFromOthers) {
  for (const std::string listen : {"127.0.0.1:0", "127.8.0.1:50551", "[::1]:50551", "unix:/run/kcs/socket"}) {
    ASSERT_EQ(socket_addresses(listen).size(), 1U) << listen;
    EXPECT_EQ(socket_addresses(listen)[0].text, listen);
    EXPECT_TRUE(socket_addresses(listen)[0].local) << listen;
  }
  for (const SocketAddress& socket : socket_addresses("localhost:1")) EXPECT_TRUE(socket.local) << socket.text;
  for (const std::string listen : {"0.0.0.0:50551", "[::]:0", "192.0.2.1:50551", "[2001:db8::1]:1"}) {
    ASSERT_EQ(socket_addresses(listen).size(), 1U) << listen;
    EXPECT_EQ(socket_addresses(listen)[0].text, listen);
    EXPECT_FALSE(socket_addresses(listen)[0].local) << listen;
  }
}

TEST(SocketAddresses, AreRefusedWhereNobodyCanListen) {
  for (const std::string listen :
       {"", "nowhere", ":50551", "127.0.0.1:", "127.0.0.1:65536", "127.0.0.1:x", "[::1]", "no.such.host.invalid:1"}) {
    EXPECT_THROW(socket_addresses(listen), std::runtime_error) << listen;
  }
}

TEST(SafeStart, LetsOnlyThisMachineInWithoutTls) {
  for (const std::string listen : {"", "127.0.0.1:0", "[::1]:0", "localhost:0", "unix:/run/kcs/socket"}) {
    EXPECT_EQ(refusal({}, listen), "") << listen;
  }
  for (const std::string listen : {"0.0.0.0:0", "[::]:0", "192.0.2.1:0"}) {
    const std::string reason = refusal({.tokens_file = "tokens.toml"}, listen);
    EXPECT_NE(reason.find(listen + " without TLS"), std::string::npos) << reason;
    EXPECT_NE(reason.find("--insecure"), std::string::npos) << reason;
    EXPECT_EQ(refusal({.insecure = true}, listen), "");
  }
}

TEST(SafeStart, LetsStrangersInOnlyWhenTold) {
  SecuritySettings settings = with_tls();
  EXPECT_NE(refusal(settings, "0.0.0.0:0").find("to everybody"), std::string::npos);
  EXPECT_EQ(refusal(settings, "127.0.0.1:0"), "");
  settings.insecure = true;
  EXPECT_EQ(refusal(settings, "0.0.0.0:0"), "");
  settings = with_tls();
  settings.tls.client_ca = "ca.pem";
  EXPECT_EQ(refusal(settings, "0.0.0.0:0"), "");
  settings = with_tls();
  settings.tokens_file = "tokens.toml";
  EXPECT_EQ(refusal(settings, "0.0.0.0:0"), "");
}

TEST(SafeStart, SettingsMustNotContradictEachOther) {
  EXPECT_NE(refusal({.tls = {.certificate = "server.pem"}}, "127.0.0.1:0"), "");
  EXPECT_NE(refusal({.tls = {.key = "key.pem"}, .insecure = true}, "127.0.0.1:0"), "");
  EXPECT_NE(refusal({.tls = {.client_ca = "ca.pem"}}, "127.0.0.1:0"), "");
  SecuritySettings settings = with_tls();
  settings.certificates.push_back({.name = "cam", .caller = security::anybody()});
  EXPECT_NE(refusal(settings, "127.0.0.1:0").find("client_ca"), std::string::npos);
  EXPECT_NE(refusal({.insecure = true}, "nowhere"), "") << "no address at all";
}

}  // namespace
}  // namespace kcs::service
