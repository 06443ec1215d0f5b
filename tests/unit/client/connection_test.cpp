// How the client library shows who it is, and to whom it does not.
#include "client/sdk/connection.h"

#include <gtest/gtest.h>

#include <string>
#include <system_error>

#include "client/sdk/planner.h"
#include "server/security/token.h"
#include "server/service/server.h"
#include "tests/certificates/authority.h"
#include "tests/files/temporary_folder.h"

namespace kcs::client {
namespace {

class ConnectionTest : public testing::Test {
 protected:
  // A server that knows the two tokens.
  service::ServerOptions server_options(const std::string& listen = "127.0.0.1:0") const {
    service::ServerOptions options;
    options.store.database = "memory";
    options.listen = listen;
    options.planning_threads = 1;
    for (const char* token : {"the-first-token", "the-second-token"}) {
      options.security.tokens.push_back(
          {.hash = security::TokenHash::of(token), .caller = {.owner = token, .roles = {security::Role::kPlan}}});
    }
    return options;
  }

  // What the server answers to somebody who asks for a plan that nobody has.
  static std::string knock(Planner& planner) {
    try {
      planner.get("plans/none");
      return "OK";
    } catch (const Error& error) {
      return error.code();
    }
  }

  static std::string refusal(const Connection& connection) {
    try {
      const Planner planner(connection);
      return "";
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), "INVALID_ARGUMENT");
      return error.what();
    }
  }

  const test::TemporaryFolder folder_;
  const std::string token_file_ = folder_.write("token", "the-first-token\n");
};

TEST_F(ConnectionTest, TokenIsReadAnewForEachCall) {
  const service::Server server(server_options());
  Planner planner({.address = server.address(), .token_file = token_file_});
  EXPECT_EQ(knock(planner), "NOT_FOUND");
  folder_.write("token", "a-token-that-is-unknown\n");
  EXPECT_EQ(knock(planner), "UNAUTHENTICATED");
  folder_.write("token", "the-second-token");
  EXPECT_EQ(knock(planner), "NOT_FOUND");
  std::filesystem::remove(token_file_);
  EXPECT_EQ(knock(planner), "UNAVAILABLE") << "it may be back soon";
}

TEST_F(ConnectionTest, TokenGoesThroughASocketOfThisMachine) {
  const service::Server server(server_options("unix:" + folder_.path("socket")));
  Planner planner({.address = server.address(), .token_file = token_file_});
  EXPECT_EQ(knock(planner), "NOT_FOUND");
  Planner nobody(server.address());
  EXPECT_EQ(knock(nobody), "UNAUTHENTICATED");
}

TEST_F(ConnectionTest, TokenIsNeverSentWhereOthersCanListen) {
  for (const std::string address :
       {"192.0.2.1:50551", "kcs.example.com:50551", "0.0.0.0:50551", "localhost.example.com:1"}) {
    const std::string reason = refusal({.address = address, .token_file = token_file_});
    EXPECT_NE(reason.find("could read the token"), std::string::npos) << address << ": " << reason;
    EXPECT_EQ(refusal({.address = address, .tls = true, .token_file = token_file_}), "") << address;
    EXPECT_EQ(refusal({.address = address}), "") << address;
  }
}

TEST_F(ConnectionTest, FilesAreReadAtTheStart) {
  EXPECT_THROW(Planner({.address = "localhost:1", .token_file = folder_.path("none")}), std::system_error);
  EXPECT_THROW(Planner({.address = "localhost:1", .tls = true, .ca_file = folder_.path("none")}), std::system_error);
  for (const std::string token : {"", "\n", "two words\n", "caf\xc3\xa9\n"}) {
    const std::string file = folder_.write("bad", token);
    EXPECT_NE(refusal({.address = "localhost:1", .token_file = file}).find("must hold a token"), std::string::npos)
        << token;
  }
  EXPECT_NE(refusal({.address = "localhost:1", .tls = true, .ca_file = token_file_}).find("PEM"), std::string::npos);
  const std::string certificate = folder_.write("client.pem", test::Authority("client").certificate());
  EXPECT_NE(refusal({.address = "localhost:1", .tls = true, .certificate_file = certificate}).find("go together"),
            std::string::npos);
}

}  // namespace
}  // namespace kcs::client
