#include "tests/service/secure_client.h"

#include <utility>

namespace kcs::service::test {

std::shared_ptr<grpc::ChannelCredentials> plain() { return grpc::InsecureChannelCredentials(); }

std::shared_ptr<grpc::ChannelCredentials> tls(const Authority& authority, const Issued& own) {
  return grpc::SslCredentials({authority.certificate(), own.key, own.certificate});
}

security::KnownToken known(const std::string& owner, security::Roles roles) {
  return {.hash = security::TokenHash::of("token-of-" + owner), .caller = {.owner = owner, .roles = roles}};
}

ServerOptions with_tokens(std::vector<security::KnownToken> tokens) {
  return {.security = {.tokens = std::move(tokens)}};
}

SecureClient::SecureClient(const std::string& address, const std::shared_ptr<grpc::ChannelCredentials>& credentials,
                           std::string token)
    : TestClient(new_channel(address, credentials), std::move(token)) {}

grpc::Status SecureClient::knock() {
  const auto context = call();
  v1::GetPlanRequest request;
  request.set_name("plans/none");
  v1::Plan plan;
  grpc::Status status = stub().GetPlan(context.get(), request, &plan);
  server_name_.clear();
  for (const grpc::string_ref& name : context->auth_context()->FindPropertyValues("x509_common_name")) {
    server_name_.assign(name.begin(), name.end());
  }
  return status;
}

Answer<v1::Plan> SecureClient::create() { return create({request(options()), request(right_angle())}); }

grpc::Status SecureClient::stream(const std::string& name) { return TestClient::stream(setpoints(name, 0.001)).status; }

SecureClient client_of(const TestServer& server, const std::string& owner) {
  return {server.address(), plain(), owner.empty() ? "" : "token-of-" + owner};
}

}  // namespace kcs::service::test
