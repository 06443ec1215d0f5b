// Whole programs on a network that one need not trust: kcsd, kcsctl and kcs-gateway with TLS and tokens.
#include <gtest/gtest.h>
#include <signal.h>

#include <string>
#include <vector>

#include "tests/certificates/authority.h"
#include "tests/files/temporary_folder.h"
#include "tests/system/child_process.h"
#include "tests/system/kcsd_process.h"

namespace kcs::test {
namespace {

// A shell runs `script`; $0 is kcsd.
Result run_shell(const std::string& script) { return run({"/bin/sh", "-c", script, KCSD}); }

// A new token, as its owner gets it.
std::string make_token(const std::string& file) {
  const Result made = run_shell("umask 077; \"$0\" --new-token > " + file);
  EXPECT_EQ(made.exit_code, 0) << made.errors;
  const Result shown = run({"/bin/cat", file});
  return shown.output.substr(0, shown.output.find('\n'));
}

class Security : public testing::Test {
 protected:
  Security() {
    const Issued server = issue_for_loopback(authority_);
    folder_.write("server.pem", server.certificate);
    folder_.write("key.pem", server.key);
    folder_.write("ca.pem", authority_.certificate());
    folder_.write("other-ca.pem", Authority("another authority").certificate());
  }

  std::string path(const std::string& name) const { return folder_.path(name); }

  std::string tls_settings() const {
    return "[security]\ncertificate = \"" + path("server.pem") + "\"\nkey = \"" + path("key.pem") + "\"\n";
  }

  // The [[tokens]] of a token in a file.
  std::string entry(const std::string& token_file, const std::string& roles) const {
    return "[[tokens]]\n" + run_shell("\"$0\" --hash-token < " + path(token_file)).output + "owner = \"" + token_file +
           "\"\nroles = [" + roles + "]\n";
  }

  const TemporaryFolder folder_;
  const Authority authority_{"the authority"};
};

// kcsd on a free port, with `config` in its configuration file.
class Kcsd {
 public:
  Kcsd(const TemporaryFolder& folder, const std::string& config, const std::string& host = "127.0.0.1",
       const std::vector<std::string>& flags = {})
      : kcsd_(command(folder, config, host, flags)) {}

  std::string port() const { return kcsd_.address().substr(kcsd_.address().rfind(':') + 1); }
  std::string address() const { return "127.0.0.1:" + port(); }
  std::string log() const { return kcsd_.process().errors(); }

 private:
  static std::vector<std::string> command(const TemporaryFolder& folder, const std::string& config,
                                          const std::string& host, const std::vector<std::string>& flags) {
    std::vector<std::string> command = {
        KCSD,       "--database", "memory",      "--config", folder.write("kcsd.toml", config),
        "--listen", host + ":0",  "--log-level", "debug"};
    command.insert(command.end(), flags.begin(), flags.end());
    return command;
  }

  KcsdProcess kcsd_;
};

TEST_F(Security, KcsdRefusesToListenToTheNetworkWithoutTls) {
  const Result refused = run({KCSD, "--database", "memory", "--listen", "0.0.0.0:0"});
  EXPECT_EQ(refused.exit_code, 1);
  EXPECT_EQ(refused.output, "");
  EXPECT_NE(refused.errors.find("does not listen on 0.0.0.0:0 without TLS"), std::string::npos) << refused.errors;
  EXPECT_NE(refused.errors.find("--insecure"), std::string::npos) << refused.errors;
  const Result open = run(
      {KCSD, "--database", "memory", "--listen", "0.0.0.0:0", "--config", folder_.write("tls.toml", tls_settings())});
  EXPECT_EQ(open.exit_code, 1);
  EXPECT_NE(open.errors.find("to everybody"), std::string::npos) << open.errors;
}

TEST_F(Security, KcsdListensToTheNetworkWhenToldAndSaysSoInTheLog) {
  const Kcsd kcsd(folder_, "", "0.0.0.0", {"--insecure"});
  EXPECT_NE(kcsd.log().find("without TLS"), std::string::npos) << kcsd.log();
  const Kcsd by_file(folder_, "[security]\ninsecure = true\n", "0.0.0.0");
  EXPECT_NE(by_file.log().find("without TLS"), std::string::npos) << by_file.log();
}

TEST_F(Security, SettingsAreRefusedWithFileAndLine) {
  const std::string hash = "hash = \"sha256:" + std::string(64, 'a') + "\"\n";
  const std::string token = "[[tokens]]\n" + hash + "owner = \"cam\"\nroles = [\"plan\"]\n";
  struct Bad {
    std::string text;
    int line;
    const char* hint;
  };
  for (const Bad& bad : {Bad{"[security]\ncertificat = \"x\"\n", 2, "certificate"},
                         Bad{"[security]\ninsecure = 1\n", 2, "true or false"},
                         Bad{"\n[[tokens]]\nowner = \"cam\"\nroles = [\"plan\"]\n", 2, "hash"},
                         Bad{"[[tokens]]\n" + hash + "roles = [\"plan\"]\n", 1, "owner"},
                         Bad{"[[tokens]]\nhash = \"kcs_secret\"\n", 2, "--hash-token"},
                         Bad{"[[tokens]]\n" + hash + "owner = \"cam\"\nroles = [\"plan\", \"root\"]\n", 4, "admin"},
                         Bad{"[[tokens]]\n" + hash + "owner = \"cam\"\nroles = []\n", 4, "roles"},
                         Bad{"[[tokens]]\n" + hash + "owner = \"\"\nroles = [\"plan\"]\n", 3, "name"},
                         Bad{token + token, 6, "second time"}, Bad{"[tokens]\n" + hash, 1, "[[tokens]]"},
                         Bad{"[[certificates]]\nowner = \"cam\"\nroles = [\"plan\"]\n", 1, "name"},
                         Bad{"[connections]\nkeepalive_s = 0\n", 2, "seconds"}}) {
    const std::string file = folder_.write("bad.toml", bad.text);
    const Result refused = run({KCSD, "--database", "memory", "--config", file, "--listen", "127.0.0.1:0"});
    EXPECT_EQ(refused.exit_code, 1) << bad.text;
    EXPECT_NE(refused.errors.find(file + ":" + std::to_string(bad.line) + ": "), std::string::npos) << refused.errors;
    EXPECT_NE(refused.errors.find(bad.hint), std::string::npos) << refused.errors;
  }
}

TEST_F(Security, NewTokenComesAloneAndItsHashIsTheOneOfTheStandardInput) {
  const Result made = run_shell("\"$0\" --new-token > " + path("token"));
  EXPECT_EQ(made.exit_code, 0);
  const Result hashed = run_shell("\"$0\" --hash-token < " + path("token"));
  EXPECT_EQ(hashed.output, made.errors) << "what is configured";
  EXPECT_TRUE(hashed.output.starts_with("hash = \"sha256:")) << hashed.output;
  const Result refused = run_shell("echo password | \"$0\" --hash-token");
  EXPECT_EQ(refused.exit_code, 1);
  EXPECT_NE(refused.errors.find("--new-token"), std::string::npos) << refused.errors;
  EXPECT_EQ(refused.errors.find("password"), std::string::npos) << refused.errors;
}

class Programs : public Security {
 protected:
  // kcsctl plans a program on the server that it is told; `flags` say more.
  Result kcsctl(const std::string& server, const std::vector<std::string>& flags,
                const std::vector<std::string>& environment = {}) const {
    std::vector<std::string> command = {"/usr/bin/env"};
    command.insert(command.end(), environment.begin(), environment.end());
    command.insert(command.end(), {KCSCTL, "plan", "--json", program_, "--server", server});
    command.insert(command.end(), flags.begin(), flags.end());
    return run(command);
  }

  void expect_failure(const Result& result, int exit_code, const std::string& hint) const {
    EXPECT_EQ(result.exit_code, exit_code) << result.errors;
    EXPECT_NE(result.errors.find(hint), std::string::npos) << result.errors;
    EXPECT_EQ(result.errors.find('\n'), result.errors.size() - 1) << "one line: " << result.errors;
    EXPECT_EQ(result.errors.find(token_), std::string::npos) << result.errors;
    EXPECT_EQ(result.errors.find(wrong_token_), std::string::npos) << result.errors;
  }

  const std::string token_ = make_token(path("token"));
  const std::string wrong_token_ = make_token(path("wrong-token"));
  const std::string program_ = folder_.write("part.ngc", "G21 G90 G64\nG1 X10 Y0 F6000\nG1 X10 Y10\n");
};

TEST_F(Programs, TalkWithTlsAndATokenThatNoLogShows) {
  Kcsd kcsd(folder_, tls_settings() + entry("token", "\"plan\", \"stream\""), "0.0.0.0");
  const std::vector<std::string> good = {"--tls-ca", path("ca.pem"), "--token-file", path("token")};
  EXPECT_EQ(kcsctl(kcsd.address(), good).exit_code, 0);
  EXPECT_EQ(kcsctl("localhost:" + kcsd.port(), good).exit_code, 0);
  EXPECT_EQ(kcsctl(kcsd.address(), {"--tls-ca", path("ca.pem")}, {"KCS_TOKEN_FILE=" + path("token")}).exit_code, 0);
  EXPECT_EQ(kcsctl(kcsd.address(), {"--tls", "--token-file", path("token")},
                   {"GRPC_DEFAULT_SSL_ROOTS_FILE_PATH=" + path("ca.pem")})
                .exit_code,
            0)
      << "roots of the system";
  const Result played = run({KCS_GATEWAY, program_, "--fast", "--json", "--server", kcsd.address(), "--tls-ca",
                             path("ca.pem"), "--token-file", path("token")});
  EXPECT_EQ(played.exit_code, 0) << played.errors;

  expect_failure(kcsctl(kcsd.address(), {"--tls-ca", path("ca.pem")}), 1, "wants a token");
  expect_failure(kcsctl(kcsd.address(), {"--tls-ca", path("ca.pem")}), 1, "--token-file");
  expect_failure(kcsctl(kcsd.address(), {"--tls-ca", path("ca.pem"), "--token-file", path("wrong-token")}), 1,
                 "does not know the token");
  expect_failure(kcsctl(kcsd.address(), {"--token-file", path("token")}), 3, "may speak TLS only");
  expect_failure(kcsctl(kcsd.address(), {"--tls-ca", path("other-ca.pem"), "--token-file", path("token")}), 3,
                 "not trusted");
  EXPECT_EQ(kcsd.log().find(token_), std::string::npos);
  EXPECT_EQ(kcsd.log().find(wrong_token_), std::string::npos);
}

TEST_F(Programs, ShowACertificateToWhoeverWantsOne) {
  const Kcsd kcsd(folder_,
                  tls_settings() + "client_ca = \"" + path("ca.pem") +
                      "\"\n[[certificates]]\nname = \"cam\"\nowner = \"cam\"\nroles = [\"plan\", \"stream\"]\n",
                  "0.0.0.0");
  const Issued cam = authority_.issue("cam");
  const Issued other = authority_.issue("other");
  folder_.write("cam.pem", cam.certificate);
  folder_.write("cam-key.pem", cam.key);
  folder_.write("other-key.pem", other.key);
  folder_.write("other.pem", other.certificate);
  EXPECT_EQ(kcsctl(kcsd.address(),
                   {"--tls-ca", path("ca.pem"), "--tls-cert", path("cam.pem"), "--tls-key", path("cam-key.pem")})
                .exit_code,
            0);
  expect_failure(kcsctl(kcsd.address(), {"--tls-ca", path("ca.pem")}), 3, "may want a client's certificate");
  expect_failure(kcsctl(kcsd.address(), {"--tls-ca", path("ca.pem"), "--tls-cert", path("other.pem"), "--tls-key",
                                         path("other-key.pem")}),
                 1, "certificate of other");
  expect_failure(kcsctl(kcsd.address(), {"--tls-ca", path("ca.pem"), "--tls-cert", path("cam.pem"), "--tls-key",
                                         path("other-key.pem")}),
                 3, "does the key belong to the certificate");
}

TEST_F(Programs, SendATokenWithoutTlsOnlyWithinThisMachine) {
  const Kcsd kcsd(folder_, entry("token", "\"plan\""));
  EXPECT_EQ(kcsctl(kcsd.address(), {"--token-file", path("token")}).exit_code, 0);
  expect_failure(kcsctl(kcsd.address(), {}), 1, "wants a token");
  expect_failure(kcsctl("192.0.2.1:50551", {"--token-file", path("token")}), 1, "could read the token");
  expect_failure(kcsctl(kcsd.address(), {"--tls-ca", path("ca.pem"), "--token-file", path("token")}), 3,
                 "speaks no TLS");
  expect_failure(kcsctl(kcsd.address(), {"--token-file", path("nowhere")}), 4, "nowhere: No such file");
}

}  // namespace
}  // namespace kcs::test
