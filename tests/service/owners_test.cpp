// Whose plans are whose, and certificates that say who calls.
#include <gtest/gtest.h>

#include <chrono>
#include <string>
#include <thread>
#include <vector>

#include "tests/certificates/authority.h"
#include "tests/files/temporary_folder.h"
#include "tests/service/kept_plans.h"
#include "tests/service/secure_client.h"

namespace kcs::service::test {
namespace {

using enum grpc::StatusCode;
using security::Role;

class Owners : public ::testing::Test {
 protected:
  // What each way to a plan answers.
  static std::vector<grpc::Status> all_ways(SecureClient& client, const std::string& name) {
    return {client.get(name).status, client.stream(name), client.corners(name).status, client.remove(name)};
  }

  TestServer server_{with_tokens({known("cam", {Role::kPlan, Role::kStream}),
                                  known("shop", {Role::kPlan, Role::kStream}), known("admin", {Role::kAdmin})})};
  SecureClient cam_ = client_of(server_, "cam");
  SecureClient shop_ = client_of(server_, "shop");
  SecureClient admin_ = client_of(server_, "admin");
};

TEST_F(Owners, AnotherOnesPlanIsAnsweredLikeOneThatIsNotThere) {
  const std::string name = cam_.create().message.name();
  const std::vector<grpc::Status> strangers = all_ways(shop_, name);
  const std::vector<grpc::Status> nobodys = all_ways(shop_, "plans/none");
  for (std::size_t way = 0; way < strangers.size(); ++way) {
    EXPECT_EQ(strangers[way].error_code(), NOT_FOUND) << way;
    EXPECT_EQ(strangers[way].error_message(), nobodys[way].error_message()) << way;
  }
  for (const grpc::Status& status : all_ways(cam_, name)) EXPECT_TRUE(status.ok()) << status.error_message();
  EXPECT_EQ(cam_.get(name).status.error_code(), NOT_FOUND) << "it was deleted";
}

TEST_F(Owners, SamePlanOfTwoStaysWhenOneDeletesIt) {
  const std::string name = cam_.create().message.name();
  EXPECT_EQ(shop_.create().message.name(), name);
  EXPECT_TRUE(cam_.remove(name).ok());
  EXPECT_EQ(cam_.get(name).status.error_code(), NOT_FOUND);
  for (const grpc::Status& status : all_ways(shop_, name)) EXPECT_TRUE(status.ok()) << status.error_message();
  EXPECT_EQ(admin_.get(name).status.error_code(), NOT_FOUND) << "it is nobody's";
}

TEST_F(Owners, PlanThatOneWaitsForIsMadeThoughAnotherDeletesIt) {
  const auto accepted = cam_.create({accept_only(options()), request(long_path())});
  ASSERT_TRUE(accepted.status.ok()) << accepted.status.error_message();
  std::thread deletes([&] {
    std::this_thread::sleep_for(std::chrono::milliseconds(300));  // the other one waits by now
    EXPECT_TRUE(cam_.remove(accepted.message.name()).ok());
  });
  const auto made = shop_.create({request(options()), request(long_path())});
  deletes.join();
  EXPECT_EQ(made.message.name(), accepted.message.name()) << made.status.error_message();
  EXPECT_TRUE(shop_.get(made.message.name()).status.ok());
}

TEST_F(Owners, AdministratorSeesAndDeletesEverybodysPlans) {
  const std::string name = cam_.create().message.name();
  shop_.create();
  for (const grpc::Status& status : all_ways(admin_, name)) EXPECT_TRUE(status.ok()) << status.error_message();
  EXPECT_EQ(cam_.get(name).status.error_code(), NOT_FOUND);
  EXPECT_EQ(shop_.get(name).status.error_code(), NOT_FOUND);
}

TEST_F(Owners, KeepWhatMemoryHasNoRoomFor) {
  TestServer small({.caps = {.cached_plans = 1},
                    .security = {.tokens = {known("cam", {Role::kPlan}), known("shop", {Role::kPlan})}}});
  SecureClient cam = client_of(small, "cam");
  SecureClient shop = client_of(small, "shop");
  const std::string name = cam.create().message.name();
  ASSERT_TRUE(cam.create({request(options()), request(path({0, 0, 5, 5}))}).status.ok());
  EXPECT_TRUE(cam.get(name).status.ok());
  EXPECT_EQ(shop.get(name).status.error_code(), NOT_FOUND);
  EXPECT_EQ(shop.create().message.name(), name);
  EXPECT_TRUE(shop.get(name).status.ok());
}

class ClientCertificates : public ::testing::Test {
 protected:
  ServerOptions options() const {
    const Issued server = kcs::test::issue_for_loopback(authority_);
    const std::string ca = folder_.write("ca.pem", authority_.certificate());
    return {.security = {
                .tls = {.certificate = folder_.write("server.pem", server.certificate),
                        .key = folder_.write("key.pem", server.key),
                        .client_ca = ca},
                .tokens = {known("cam", {Role::kPlan})},
                .certificates = {{"gateway-1.example.com", {.owner = "gateway", .roles = {Role::kPlan, Role::kStream}}},
                                 {"cam", {.owner = "cam", .roles = {Role::kPlan}}}}}};
  }

  SecureClient client(TestServer& server, const std::string& common_name, const std::string& alternative_names = "",
                      const std::string& token = "") const {
    return {server.address(), tls(authority_, authority_.issue(common_name, alternative_names)), token};
  }

  const kcs::test::TemporaryFolder folder_;
  const Authority authority_{"the authority"};
};

TEST_F(ClientCertificates, SayWhoCalls) {
  TestServer server(options());
  SecureClient cam = client(server, "cam");
  const std::string name = cam.create().message.name();
  EXPECT_TRUE(cam.get(name).status.ok());
  EXPECT_EQ(cam.stream(name).error_code(), PERMISSION_DENIED);
  SecureClient gateway = client(server, "whatever", "DNS:gateway-1.example.com");
  EXPECT_EQ(gateway.get(name).status.error_code(), NOT_FOUND);
  EXPECT_EQ(gateway.create().message.name(), name);
  EXPECT_TRUE(gateway.stream(name).ok());
}

TEST_F(ClientCertificates, ThatAreNotNamedAreRefused) {
  TestServer server(options());
  const grpc::Status status = client(server, "somebody").knock();
  EXPECT_EQ(status.error_code(), UNAUTHENTICATED);
  EXPECT_NE(status.error_message().find("somebody"), std::string::npos) << status.error_message();
  EXPECT_EQ(client(server, "cam", "DNS:somebody.example.com").knock().error_code(), UNAUTHENTICATED)
      << "with alternative names the common name counts for nothing";
}

TEST_F(ClientCertificates, GiveWayToAToken) {
  TestServer server(options());
  EXPECT_EQ(client(server, "somebody", "", "token-of-cam").knock().error_code(), NOT_FOUND);
  EXPECT_EQ(client(server, "cam", "", "token-of-nobody").knock().error_code(), UNAUTHENTICATED);
}

}  // namespace
}  // namespace kcs::service::test
