// The balancer of deploy/kubernetes, between a kcsd with TLS and a gateway and an operator outside: who gets past it.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "tests/certificates/authority.h"
#include "tests/cluster/balancer_file.h"
#include "tests/files/temporary_folder.h"
#include "tests/system/child_process.h"
#include "tests/system/free_port.h"
#include "tests/system/kcsd_process.h"

namespace kcs::test {
namespace {

constexpr std::chrono::seconds kPatience{60};

class MutualTls : public testing::Test {
 protected:
  void SetUp() override {
    if (!std::filesystem::exists(kHaproxy)) GTEST_SKIP() << "haproxy is not installed";
    write_secrets();
    start_kcsd();
    start_balancer();
    start_gateway();
  }

  std::string path(const std::string& name) const { return folder_.path(name); }

  // `kcsctl machines` at the balancer, with these flags beside.
  Result list_machines(std::vector<std::string> flags) const {
    flags.insert(flags.begin(),
                 {KCSCTL, "machines", "--server", fmt::format("localhost:{}", port_), "--tls-ca", path("ca.crt")});
    return run(flags);
  }
  std::vector<std::string> certificate(const std::string& name) const {
    return {"--tls-cert", path(name + ".pem"), "--tls-key", path(name + ".key")};
  }

 private:
  void write_secrets() {
    const Authority authority("the authority");
    folder_.write("ca.crt", authority.certificate());
    const Issued ours = authority.issue("kcs", "DNS:kcsd.kcs.svc,DNS:localhost");
    folder_.write("tls.crt", ours.certificate);
    folder_.write("tls.key", ours.key);
    write_client("mill", authority);
    write_client("stranger", Authority("another authority"));
    const Result made =
        run({"/bin/sh", "-c", "umask 077; \"$0\" --new-token >\"$1\" 2>/dev/null && \"$0\" --hash-token <\"$1\"", KCSD,
             path("token")});
    folder_.write("tokens.toml", "[[tokens]]\n" + made.output + "owner = \"shop\"\nroles = [\"machine\"]\n");
  }

  void write_client(const std::string& name, const Authority& authority) const {
    const Issued issued = authority.issue(name, "DNS:" + name + ".example.com");
    folder_.write(name + ".pem", issued.certificate);
    folder_.write(name + ".key", issued.key);
  }

  void start_kcsd() {
    const std::string settings = fmt::format(
        "[security]\ncertificate = \"{0}/tls.crt\"\nkey = \"{0}/tls.key\"\nclient_ca = \"{0}/ca.crt\"\n"
        "tokens_file = \"{0}/tokens.toml\"\n",
        folder_.path().string());
    kcsd_ = std::make_unique<KcsdProcess>(std::vector<std::string>{
        KCSD, "--database", "memory", "--threads", "1", "--config", folder_.write("kcsd.toml", settings), "--listen",
        "127.0.0.1:0", "--http-listen", fmt::format("127.0.0.1:{}", figures_port_)});
  }

  // The shipped one, with addresses and files of this machine instead of those of a cluster.
  void start_balancer() {
    std::string text = shipped_balancer("kubernetes");
    replace(text, "/certificates/", folder_.path().string() + "/");
    replace(text, "server-template kcsd 12 kcsd.kcs.svc.cluster.local:50551", "server kcsd " + kcsd_->address());
    replace(text, "check port 50552", fmt::format("check port {}", figures_port_));
    replace(text, " resolvers cluster init-addr none", "");
    replace(text, "maxconn 20000", "maxconn 2000");  // what any machine has files for
    replace(text, "bind :50551", fmt::format("bind 127.0.0.1:{}", port_));
    replace(text, "bind :8404", fmt::format("bind 127.0.0.1:{}", free_port()));
    balancer_ =
        std::make_unique<ChildProcess>(std::vector<std::string>{kHaproxy, "-db", "-f", folder_.write("h.cfg", text)});
  }

  // Waits until it is attached: it tries again until all others are there.
  void start_gateway() {
    const std::string settings = fmt::format(
        "[machine]\nname = \"mill\"\n[simulated]\nprofile = \"router\"\n[server]\naddress = \"localhost:{1}\"\n"
        "tls_ca = \"{0}/ca.crt\"\ntls_cert = \"{0}/mill.pem\"\ntls_key = \"{0}/mill.key\"\ntoken_file = "
        "\"{0}/token\"\n",
        folder_.path().string(), port_);
    gateway_ = std::make_unique<ChildProcess>(
        std::vector<std::string>{KCS_GATEWAY, "attach", "--config", folder_.write("mill.toml", settings)});
    const auto end = std::chrono::steady_clock::now() + kPatience;
    while (gateway_->errors().find(" attached server=") == std::string::npos) {
      ASSERT_LT(std::chrono::steady_clock::now(), end) << gateway_->errors() << balancer_->errors();
      std::this_thread::sleep_for(std::chrono::milliseconds(50));
    }
  }

  const TemporaryFolder folder_;
  const int port_ = free_port(), figures_port_ = free_port();
  std::unique_ptr<KcsdProcess> kcsd_;
  std::unique_ptr<ChildProcess> balancer_, gateway_;
};

TEST_F(MutualTls, GatewayAndOperatorMeetThroughTheBalancer) {
  std::vector<std::string> flags = certificate("mill");
  flags.insert(flags.end(), {"--token-file", path("token")});
  const Result listed = list_machines(flags);
  EXPECT_EQ(listed.exit_code, 0) << listed.errors;
  EXPECT_NE(listed.output.find("machines/mill"), std::string::npos) << listed.output;
}

TEST_F(MutualTls, WhoShowsNoCertificateOfTheAuthorityIsTurnedAwayByTheBalancer) {
  EXPECT_EQ(list_machines({"--token-file", path("token")}).exit_code, 3);
  std::vector<std::string> flags = certificate("stranger");
  flags.insert(flags.end(), {"--token-file", path("token")});
  EXPECT_EQ(list_machines(flags).exit_code, 3);
}

TEST_F(MutualTls, CallersAreKnownByTheirTokensAndNotByTheBalancersCertificate) {
  const Result refused = list_machines(certificate("mill"));
  EXPECT_EQ(refused.exit_code, 1);
  EXPECT_NE(refused.errors.find("wants a token"), std::string::npos) << refused.errors;
}

}  // namespace
}  // namespace kcs::test
