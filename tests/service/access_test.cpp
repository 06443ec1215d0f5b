// Who calls, and what he may do.
#include <grpcpp/impl/rpc_method.h>
#include <gtest/gtest.h>

#include <map>
#include <set>
#include <string>
#include <vector>

#include "server/security/token.h"
#include "tests/files/temporary_folder.h"
#include "tests/service/secure_client.h"

namespace kcs::service::test {
namespace {

using enum grpc::StatusCode;
using security::KnownToken;
using security::Role;
using security::Roles;
using security::TokenHash;

// Calls a method with an empty request.
grpc::Status call_empty(Call& call, const std::shared_ptr<grpc::Channel>& channel, const std::string& method) {
  const std::unique_ptr<grpc::ClientReaderWriter<grpc::ByteBuffer, grpc::ByteBuffer>> stream(
      grpc::internal::ClientReaderWriterFactory<grpc::ByteBuffer, grpc::ByteBuffer>::Create(
          channel.get(), grpc::internal::RpcMethod(method.c_str(), grpc::internal::RpcMethod::BIDI_STREAMING), &call));
  const grpc::Slice nothing("");
  stream->Write(grpc::ByteBuffer(&nothing, 1));
  stream->WritesDone();
  for (grpc::ByteBuffer answer; stream->Read(&answer);) continue;
  return stream->Finish();
}

// The same of the planning service: what it answers to a caller who may call it differs from method to method, but
// never is UNAUTHENTICATED or PERMISSION_DENIED.
grpc::StatusCode call_empty(const SecureClient& client, const std::string& method) {
  return call_empty(*client.call(), client.channel(), "/kcs.v1.PlanningService/" + method).error_code();
}

TEST(Roles, OpenJustTheirMethods) {
  const std::set<std::string> of_plan = {"CreatePlan", "GetPlan",    "ListPlans",
                                         "WatchPlan",  "DeletePlan", "DescribeCorners"};
  const std::set<std::string> of_stream = {"GetPlan", "StreamSetpoints"};
  std::set<std::string> of_both = {"PlanLive"};
  of_both.insert(of_plan.begin(), of_plan.end());
  of_both.insert(of_stream.begin(), of_stream.end());
  const std::map<std::string, std::pair<Roles, std::set<std::string>>> callers = {
      {"planner", {{Role::kPlan}, of_plan}},
      {"player", {{Role::kStream}, of_stream}},
      {"both", {{Role::kPlan, Role::kStream}, of_both}},
      {"machine", {{Role::kMachine}, {}}},
      {"admin", {{Role::kAdmin}, of_both}}};
  std::vector<KnownToken> tokens;
  for (const auto& [owner, caller] : callers) tokens.push_back(known(owner, caller.first));
  TestServer server(with_tokens(tokens));

  const auto* service = v1::Plan::descriptor()->file()->FindServiceByName("PlanningService");
  for (int i = 0; i < service->method_count(); ++i) {
    const std::string& method = service->method(i)->name();
    EXPECT_TRUE(of_both.contains(method)) << method << " is in no role of this test";
    for (const auto& [owner, caller] : callers) {
      const grpc::StatusCode code = call_empty(client_of(server, owner), method);
      if (code == UNIMPLEMENTED) continue;
      EXPECT_EQ(code != PERMISSION_DENIED, caller.second.contains(method)) << owner << " calls " << method;
      EXPECT_NE(code, UNAUTHENTICATED) << owner << " calls " << method;
    }
    const grpc::StatusCode code = call_empty(client_of(server, ""), method);
    EXPECT_TRUE(code == UNAUTHENTICATED || code == UNIMPLEMENTED) << "a stranger calls " << method;
  }
}

TEST(Roles, RefusalSaysWhichOneIsMissing) {
  TestServer server(with_tokens({known("player", {Role::kStream})}));
  const grpc::Status status = client_of(server, "player").create().status;
  EXPECT_EQ(status.error_code(), PERMISSION_DENIED);
  EXPECT_NE(status.error_message().find("CreatePlan needs the role plan; player has stream"), std::string::npos)
      << status.error_message();
}

TEST(Tokens, ThatAreUnknownOrMissingAreRefusedWithARemedyAndNotRepeated) {
  TestServer server(with_tokens({known("cam", {Role::kPlan})}));
  EXPECT_EQ(client_of(server, "cam").knock().error_code(), NOT_FOUND);
  for (const std::string token : {"token-of-cam ", "token-of-ca", "Token-of-cam", "x"}) {
    const grpc::Status status = SecureClient(server.address(), plain(), token).knock();
    EXPECT_EQ(status.error_code(), UNAUTHENTICATED) << token;
    EXPECT_EQ(status.error_message().find(token == "x" ? " x " : token), std::string::npos) << status.error_message();
  }
  const grpc::Status status = client_of(server, "").knock();
  EXPECT_EQ(status.error_code(), UNAUTHENTICATED);
  EXPECT_NE(status.error_message().find("Bearer TOKEN"), std::string::npos) << status.error_message();
}

TEST(Tokens, ComeOnceInTheBearerScheme) {
  TestServer server(with_tokens({known("cam", {Role::kPlan}), known("shop", {Role::kPlan})}));
  const auto knock = [&server](const std::vector<std::string>& values) {
    Call call;
    for (const std::string& value : values) call.AddMetadata("authorization", value);
    v1::GetPlanRequest request;
    request.set_name("plans/none");
    v1::Plan plan;
    return server.stub().GetPlan(&call, request, &plan).error_code();
  };
  EXPECT_EQ(knock({"Bearer token-of-cam"}), NOT_FOUND);
  EXPECT_EQ(knock({"bEARER token-of-cam"}), NOT_FOUND);
  for (const std::string value :
       {"token-of-cam", "Basic token-of-cam", "Bearer", "Bearer ", "", "Bearertoken-of-cam"}) {
    EXPECT_EQ(knock({value}), UNAUTHENTICATED) << value;
  }
  EXPECT_EQ(knock({"Bearer token-of-cam", "Bearer token-of-shop"}), UNAUTHENTICATED);
}

class TokensInAFile : public ::testing::Test {
 protected:
  static std::string entry(const std::string& owner) {
    return "[[tokens]]\nhash = \"" + TokenHash::of("token-of-" + owner).text() + "\"\nowner = \"" + owner +
           "\"\nroles = [\"plan\"]\n";
  }
  void write(const std::string& text) const { folder_.write("tokens.toml", text); }
  ServerOptions options() const { return {.security = {.tokens_file = folder_.path("tokens.toml")}}; }

  const kcs::test::TemporaryFolder folder_;
};

TEST_F(TokensInAFile, AreGivenAndRevokedWithoutRestart) {
  write(entry("cam") + entry("shop"));
  TestServer server(options());
  SecureClient cam = client_of(server, "cam");
  SecureClient shop = client_of(server, "shop");
  SecureClient late = client_of(server, "late");
  EXPECT_EQ(cam.knock().error_code(), NOT_FOUND);
  EXPECT_EQ(late.knock().error_code(), UNAUTHENTICATED);
  write(entry("shop") + entry("late"));
  EXPECT_TRUE(eventually([&] { return cam.knock().error_code() == UNAUTHENTICATED; }));
  EXPECT_EQ(late.knock().error_code(), NOT_FOUND);
  EXPECT_EQ(shop.knock().error_code(), NOT_FOUND);
  write("");
  EXPECT_TRUE(eventually([&] { return shop.knock().error_code() == UNAUTHENTICATED; }));
  EXPECT_EQ(client_of(server, "").knock().error_code(), UNAUTHENTICATED) << "no tokens do not mean everybody";
}

TEST_F(TokensInAFile, StayAsTheyAreWhileTheFileCannotBeRead) {
  write(entry("cam"));
  TestServer server(options());
  SecureClient cam = client_of(server, "cam");
  SecureClient late = client_of(server, "late");
  for (const std::string& broken :
       {std::string("[[tokens]"), entry("late") + "[[tokens]]\nhash = 1\n", std::string()}) {
    if (broken.empty()) {
      std::filesystem::remove(folder_.path("tokens.toml"));
    } else {
      write(broken);
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(600));  // it is looked at twice a second
    EXPECT_EQ(cam.knock().error_code(), NOT_FOUND) << broken;
    EXPECT_EQ(late.knock().error_code(), UNAUTHENTICATED) << broken;
  }
  write(entry("late"));
  EXPECT_TRUE(eventually([&] { return late.knock().error_code() == NOT_FOUND; }));
  EXPECT_EQ(cam.knock().error_code(), UNAUTHENTICATED);
}

TEST_F(TokensInAFile, MustBeReadableAtTheStart) {
  EXPECT_THROW(TestServer{options()}, std::runtime_error);
  write("[[tokens]]\nowner = \"cam\"\n");
  try {
    TestServer server(options());
    FAIL();
  } catch (const std::runtime_error& refused) {
    EXPECT_TRUE(std::string(refused.what()).starts_with(folder_.path("tokens.toml") + ":1: ")) << refused.what();
  }
}

TEST(Access, IsForEverybodyWhereNobodyIsToldApart) {
  TestServer server;
  SecureClient anybody = client_of(server, "");
  const std::string name = anybody.create().message.name();
  EXPECT_TRUE(client_of(server, "cam").get(name).status.ok()) << "a token is of no interest";
  EXPECT_TRUE(anybody.stream(name).ok());
  EXPECT_TRUE(anybody.remove(name).ok());
}

TEST(Access, HealthAndReflectionNeedNoToken) {
  TestServer server(with_tokens({known("cam", {Role::kPlan})}));
  for (const char* method :
       {"/grpc.health.v1.Health/Check", "/grpc.reflection.v1alpha.ServerReflection/ServerReflectionInfo"}) {
    Call call;
    EXPECT_TRUE(call_empty(call, server.channel(), method).ok()) << method;
  }
}

}  // namespace
}  // namespace kcs::service::test
