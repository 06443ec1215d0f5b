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
    : token_(std::move(token)) {
  grpc::ChannelArguments arguments;
  arguments.SetInt(GRPC_ARG_USE_LOCAL_SUBCHANNEL_POOL, 1);
  channel_ = grpc::CreateCustomChannel(address, credentials, arguments);
  stub_ = v1::PlanningService::NewStub(channel_);
}

std::unique_ptr<Call> SecureClient::call() const {
  auto call = std::make_unique<Call>();
  if (!token_.empty()) call->AddMetadata("authorization", "Bearer " + token_);
  return call;
}

grpc::Status SecureClient::knock() {
  const auto context = call();
  v1::GetPlanRequest request;
  request.set_name("plans/none");
  v1::Plan plan;
  grpc::Status status = stub_->GetPlan(context.get(), request, &plan);
  server_name_.clear();
  for (const grpc::string_ref& name : context->auth_context()->FindPropertyValues("x509_common_name")) {
    server_name_.assign(name.begin(), name.end());
  }
  return status;
}

Answer<v1::Plan> SecureClient::create() {
  Answer<v1::Plan> answer;
  const auto context = call();
  const auto writer = stub_->CreatePlan(context.get(), &answer.message);
  if (writer->Write(request(options()))) writer->Write(request(right_angle()));
  writer->WritesDone();
  answer.status = writer->Finish();
  return answer;
}

grpc::Status SecureClient::get(const std::string& name) {
  const auto context = call();
  v1::GetPlanRequest request;
  request.set_name(name);
  v1::Plan plan;
  return stub_->GetPlan(context.get(), request, &plan);
}

grpc::Status SecureClient::remove(const std::string& name) {
  const auto context = call();
  v1::DeletePlanRequest request;
  request.set_name(name);
  google::protobuf::Empty nothing;
  return stub_->DeletePlan(context.get(), request, &nothing);
}

grpc::Status SecureClient::stream(const std::string& name) {
  const auto context = call();
  const auto reader = stub_->StreamSetpoints(context.get(), setpoints(name, 0.001));
  for (v1::SetpointBatch batch; reader->Read(&batch);) continue;
  return reader->Finish();
}

grpc::Status SecureClient::corners(const std::string& name) {
  const auto context = call();
  v1::DescribeCornersRequest request;
  request.set_name(name);
  const auto reader = stub_->DescribeCorners(context.get(), request);
  for (v1::CornerBatch batch; reader->Read(&batch);) continue;
  return reader->Finish();
}

SecureClient client_of(const TestServer& server, const std::string& owner) {
  return {server.address(), plain(), owner.empty() ? "" : "token-of-" + owner};
}

}  // namespace kcs::service::test
