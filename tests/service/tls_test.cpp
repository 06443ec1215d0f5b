// TLS: who gets in, and certificates that are replaced while the server runs.
#include <gtest/gtest.h>
#include <openssl/bio.h>
#include <openssl/ssl.h>

#include <atomic>
#include <filesystem>
#include <memory>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "tests/certificates/authority.h"
#include "tests/files/temporary_folder.h"
#include "tests/service/secure_client.h"

namespace kcs::service::test {
namespace {

constexpr grpc::StatusCode kLetIn = grpc::StatusCode::NOT_FOUND;
constexpr grpc::StatusCode kTurnedAway = grpc::StatusCode::UNAVAILABLE;

class Tls : public ::testing::Test {
 protected:
  Tls() {
    write(server_);
    folder_.write("client-ca.pem", authority_.certificate());
  }

  void write(const Issued& issued) const {
    folder_.write("server.pem", issued.certificate);
    folder_.write("server-key.pem", issued.key);
  }

  ServerOptions options() const {
    return {.security = {.tls = {.certificate = folder_.path("server.pem"), .key = folder_.path("server-key.pem")}}};
  }

  ServerOptions mutual() const {
    ServerOptions mutual = options();
    mutual.security.tls.client_ca = folder_.path("client-ca.pem");
    return mutual;
  }

  // What a new connection gets: the code, and the server's name in its certificate.
  static grpc::StatusCode knock(TestServer& server, const std::shared_ptr<grpc::ChannelCredentials>& credentials,
                                std::string* server_name = nullptr) {
    SecureClient client(server.address(), credentials);
    const grpc::Status status = client.knock();
    if (server_name != nullptr) *server_name = client.server_name();
    return status.error_code();
  }

  std::string name_shown_by(TestServer& server) const {
    std::string name;
    EXPECT_EQ(knock(server, tls(authority_), &name), kLetIn);
    return name;
  }

  const kcs::test::TemporaryFolder folder_;
  const Authority authority_{"the authority"};
  const Authority other_authority_{"another authority"};
  const Issued server_ = kcs::test::issue_for_loopback(authority_, "the first");
  const Issued next_ = kcs::test::issue_for_loopback(authority_, "the second");
};

TEST_F(Tls, PlansForWhoeverTrustsTheServer) {
  TestServer server(options());
  SecureClient client(server.address(), tls(authority_));
  const auto plan = client.create();
  ASSERT_TRUE(plan.status.ok()) << plan.status.error_message();
  EXPECT_TRUE(client.stream(plan.message.name()).ok());
  EXPECT_EQ(client.knock().error_code(), kLetIn);
  EXPECT_EQ(client.server_name(), "the first");
}

TEST_F(Tls, PlainClientIsTurnedAway) {
  TestServer server(options());
  EXPECT_EQ(knock(server, plain()), kTurnedAway);
}

TEST_F(Tls, ServerOfAnotherAuthorityOrNameIsNotTrusted) {
  TestServer server(options());
  EXPECT_EQ(knock(server, tls(other_authority_)), kTurnedAway);
  write(authority_.issue("elsewhere", "DNS:kcs.example.com"));
  EXPECT_EQ(knock(server, tls(authority_)), kTurnedAway);
}

TEST_F(Tls, MutualTlsLetsInWhoeverShowsACertificateOfTheAuthority) {
  TestServer server(mutual());
  EXPECT_EQ(knock(server, tls(authority_, authority_.issue("client"))), kLetIn);
  EXPECT_EQ(knock(server, tls(authority_)), kTurnedAway) << "no certificate";
  EXPECT_EQ(knock(server, tls(authority_, other_authority_.issue("client"))), kTurnedAway) << "another authority's";
  EXPECT_EQ(knock(server, tls(authority_, authority_.issue("client", "", std::chrono::seconds(-5)))), kTurnedAway)
      << "expired";
  EXPECT_EQ(knock(server, plain()), kTurnedAway);
}

// Whether a client that knows nothing newer than `newest` gets through its handshake.
bool shakes_hands(const std::string& address, int newest) {
  const std::unique_ptr<SSL_CTX, decltype(&SSL_CTX_free)> context(SSL_CTX_new(TLS_client_method()), &SSL_CTX_free);
  SSL_CTX_set_security_level(context.get(), 0);  // or this side would refuse the old versions
  SSL_CTX_set_min_proto_version(context.get(), TLS1_VERSION);
  SSL_CTX_set_max_proto_version(context.get(), newest);
  const std::unique_ptr<BIO, decltype(&BIO_free_all)> connection(BIO_new_ssl_connect(context.get()), &BIO_free_all);
  BIO_set_conn_hostname(connection.get(), address.c_str());
  return BIO_do_handshake(connection.get()) == 1;
}

TEST_F(Tls, SpeaksNoVersionBefore12) {
  TestServer server(options());
  EXPECT_FALSE(shakes_hands(server.address(), TLS1_1_VERSION));
  EXPECT_TRUE(shakes_hands(server.address(), TLS1_2_VERSION));
  EXPECT_TRUE(shakes_hands(server.address(), TLS1_3_VERSION));
}

TEST_F(Tls, DoesNotStartWithCertificatesThatAreNotSound) {
  write(authority_.issue("late", "DNS:localhost", std::chrono::seconds(-5)));
  EXPECT_THROW(TestServer{options()}, std::runtime_error);
  write({.certificate = server_.certificate, .key = next_.key});
  EXPECT_THROW(TestServer{options()}, std::runtime_error);
  std::filesystem::remove(folder_.path("server.pem"));
  EXPECT_THROW(TestServer{options()}, std::runtime_error);
}

TEST_F(Tls, NewConnectionsSeeANewCertificateWhileAStreamGoesOn) {
  TestServer server(options());
  SecureClient client(server.address(), tls(authority_));
  const auto context = client.call();
  auto request = setpoints(client.create().message.name(), 1e-5);
  request.set_batch_size(1);
  const auto reader = client.stub().StreamSetpoints(context.get(), request);
  v1::SetpointBatch batch;
  ASSERT_TRUE(reader->Read(&batch));

  write(next_);
  EXPECT_EQ(name_shown_by(server), "the second");
  EXPECT_EQ(client.knock().error_code(), kLetIn);
  EXPECT_EQ(client.server_name(), "the first") << "the old connection is the same";

  std::uint64_t count = 1;
  while (reader->Read(&batch)) ++count;
  EXPECT_TRUE(reader->Finish().ok());
  EXPECT_EQ(count, batch.setpoint_count());
}

TEST_F(Tls, FilesThatAreNotSoundLeaveTheCertificateAsItIs) {
  TestServer server(options());
  folder_.write("server-key.pem", next_.key);  // half of the replacement
  EXPECT_EQ(name_shown_by(server), "the first");
  folder_.write("server.pem", next_.certificate.substr(0, next_.certificate.size() / 2));
  EXPECT_EQ(name_shown_by(server), "the first");
  std::filesystem::remove(folder_.path("server.pem"));
  EXPECT_EQ(name_shown_by(server), "the first");
  write(authority_.issue("late", "DNS:localhost", std::chrono::seconds(-5)));
  EXPECT_EQ(name_shown_by(server), "the first");
  write(next_);
  EXPECT_EQ(name_shown_by(server), "the second");
}

TEST_F(Tls, NoConnectionIsLostWhileTheFilesAreReplaced) {
  TestServer server(options());
  std::atomic<int> lost = 0;
  std::vector<std::thread> clients;
  for (int i = 0; i < 4; ++i) {
    clients.emplace_back([&] {
      for (int k = 0; k < 25; ++k) lost += knock(server, tls(authority_)) != kLetIn;
    });
  }
  // Now one file is another one's, now it is empty or half written.
  for (int i = 0; i < 200; ++i) {
    write(i % 2 == 0 ? next_ : server_);
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  for (std::thread& client : clients) client.join();
  EXPECT_EQ(lost, 0);
}

TEST_F(Tls, NewConnectionsMeetTheNewAuthorityOfTheClients) {
  TestServer server(mutual());
  const auto client = tls(authority_, authority_.issue("client"));
  const auto other_client = tls(authority_, other_authority_.issue("client"));
  SecureClient open(server.address(), client);
  EXPECT_EQ(open.knock().error_code(), kLetIn);
  folder_.write("client-ca.pem", other_authority_.certificate());
  EXPECT_EQ(knock(server, other_client), kLetIn);
  EXPECT_EQ(knock(server, client), kTurnedAway);
  EXPECT_EQ(open.knock().error_code(), kLetIn) << "a connection that is open";
  folder_.write("client-ca.pem", authority_.certificate() + other_authority_.certificate());
  EXPECT_EQ(knock(server, client), kLetIn);
  EXPECT_EQ(knock(server, other_client), kLetIn);
}

TEST_F(Tls, ConnectionIsReplacedAtItsAge) {
  ServerOptions young = options();
  young.connections.longest_age = std::chrono::milliseconds(300);
  TestServer server(young);
  SecureClient client(server.address(), tls(authority_));
  EXPECT_EQ(client.knock().error_code(), kLetIn);
  write(next_);
  EXPECT_TRUE(eventually([&client] {
    EXPECT_EQ(client.knock().error_code(), kLetIn) << "a call is lost";
    return client.server_name() == "the second";
  }));
}

}  // namespace
}  // namespace kcs::service::test
