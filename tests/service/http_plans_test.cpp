// Who gets no plans over HTTP, whatever else he may.
#include <gtest/gtest.h>
#include <httplib.h>

#include <string>

#include "tests/certificates/authority.h"
#include "tests/files/temporary_folder.h"
#include "tests/service/test_server.h"

namespace kcs::service::test {
namespace {

TEST(HttpPlansPolicy, WhereGrpcAsksForCertificatesNobodyIsLetInWithoutOne) {
  const kcs::test::Authority authority("the authority");
  const kcs::test::Issued own = kcs::test::issue_for_loopback(authority);
  const kcs::test::TemporaryFolder folder;
  ServerOptions options;
  options.observe.http_listen = "127.0.0.1:0";
  options.security.tls = {.certificate = folder.write("server.pem", own.certificate),
                          .key = folder.write("key.pem", own.key),
                          .client_ca = folder.write("ca.pem", authority.certificate())};
  LoopbackServer server(options);
  httplib::Client client("http://" + server.server().http_address());
  const auto refused = client.Post("/v1/plans?machine=router", "G1 X1 F100\n", "text/plain");
  ASSERT_TRUE(refused);
  EXPECT_EQ(refused->status, 403);
  EXPECT_NE(refused->body.find("certificates"), std::string::npos) << refused->body;
  EXPECT_EQ(client.Get("/healthz")->status, 200);
}

}  // namespace
}  // namespace kcs::service::test
