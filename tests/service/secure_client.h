// A client that shows a certificate or a token, or none.
#pragma once

#include <grpcpp/grpcpp.h>

#include <memory>
#include <string>
#include <vector>

#include "tests/certificates/authority.h"
#include "tests/service/test_server.h"

namespace kcs::service::test {

using kcs::test::Authority;
using kcs::test::Issued;

std::shared_ptr<grpc::ChannelCredentials> plain();
// TLS with a server that `authority` stands behind; `own` is shown to it.
std::shared_ptr<grpc::ChannelCredentials> tls(const Authority& authority, const Issued& own = {});

// A token that a server knows: that of the owner "cam" is "token-of-cam".
security::KnownToken known(const std::string& owner, security::Roles roles);
ServerOptions with_tokens(std::vector<security::KnownToken> tokens);

class SecureClient : public TestClient {
 public:
  // On a connection of its own. token: empty: none is sent.
  SecureClient(const std::string& address, const std::shared_ptr<grpc::ChannelCredentials>& credentials,
               std::string token = "");

  // Asks for a plan that nobody has. NOT_FOUND: the server let us in.
  grpc::Status knock();
  // The common name in the server's certificate, as the last knock saw it.
  const std::string& server_name() const { return server_name_; }

  using TestClient::create;
  // Plans the right angle of the worked example.
  Answer<v1::Plan> create();
  // All setpoints of a plan.
  grpc::Status stream(const std::string& name);

 private:
  std::string server_name_;
};

// Without TLS, and with the token of that owner; empty: with none.
SecureClient client_of(const TestServer& server, const std::string& owner);

}  // namespace kcs::service::test
