// What is checked before a certificate is used.
#include "server/security/certificates.h"

#include <gtest/gtest.h>

#include <stdexcept>
#include <string>

#include "tests/certificates/authority.h"
#include "tests/files/temporary_folder.h"

namespace kcs::security {
namespace {

class CertificatesTest : public testing::Test {
 protected:
  CertificatesTest() {
    folder_.write("certificate.pem", server_.certificate);
    folder_.write("key.pem", server_.key);
    folder_.write("ca.pem", authority_.certificate());
  }

  // What is wrong with the files as they are; empty if nothing is.
  std::string trouble() const {
    try {
      require_sound(read_certificates(files_), files_);
      return "";
    } catch (const std::runtime_error& refused) {
      return refused.what();
    }
  }

  void expect_trouble_with(const std::string& file, const std::string& hint) const {
    EXPECT_TRUE(trouble().starts_with(folder_.path(file) + ": ")) << trouble();
    EXPECT_NE(trouble().find(hint), std::string::npos) << trouble();
  }

  const test::TemporaryFolder folder_;
  const test::Authority authority_{"the authority"};
  const test::Issued server_ = test::issue_for_loopback(authority_);
  const CertificateFiles files_{folder_.path("certificate.pem"), folder_.path("key.pem"), folder_.path("ca.pem")};
};

TEST_F(CertificatesTest, ThatBelongTogetherAreSound) {
  EXPECT_EQ(trouble(), "");
  folder_.write("certificate.pem", server_.certificate + authority_.certificate());
  EXPECT_EQ(trouble(), "") << "a whole chain";
  const std::string description = describe(read_certificates(files_));
  EXPECT_TRUE(description.starts_with("CN=kcsd, valid until ")) << description;
}

TEST_F(CertificatesTest, KeyOfAnotherCertificateIsRefused) {
  folder_.write("key.pem", test::issue_for_loopback(authority_).key);
  expect_trouble_with("key.pem", "is not the key of");
}

TEST_F(CertificatesTest, HalfWrittenFilesAreRefused) {
  const std::string& whole = server_.certificate;
  const std::string& next = authority_.certificate();
  for (const std::size_t size : {std::size_t{0}, std::size_t{10}, whole.size() / 2, whole.size() - 5}) {
    folder_.write("certificate.pem", whole.substr(0, size));
    expect_trouble_with("certificate.pem", "whole");
  }
  for (const std::size_t size : {next.size() / 2, next.size() - 5}) {
    folder_.write("certificate.pem", whole + next.substr(0, size));
    expect_trouble_with("certificate.pem", "whole");
  }
  folder_.write("certificate.pem", whole);
  folder_.write("key.pem", server_.key.substr(0, server_.key.size() / 2));
  expect_trouble_with("key.pem", "private key");
  folder_.write("key.pem", server_.key);
  folder_.write("ca.pem", "no certificate at all");
  expect_trouble_with("ca.pem", "PEM");
}

TEST_F(CertificatesTest, ExpiredCertificateIsRefused) {
  const test::Issued expired = authority_.issue("kcsd", "DNS:localhost", std::chrono::seconds(-5));
  folder_.write("certificate.pem", expired.certificate);
  folder_.write("key.pem", expired.key);
  expect_trouble_with("certificate.pem", "expired");
}

TEST_F(CertificatesTest, WeakCertificateIsRefused) {
  const test::Issued weak = authority_.issue("kcsd", "DNS:localhost", std::chrono::hours(1), "prime192v1");
  folder_.write("certificate.pem", weak.certificate);
  folder_.write("key.pem", weak.key);
  expect_trouble_with("certificate.pem", "too small");
}

TEST_F(CertificatesTest, MissingFileIsNamed) {
  std::filesystem::remove(folder_.path("key.pem"));
  expect_trouble_with("key.pem", "No such file");
  EXPECT_TRUE(std::filesystem::create_directory(folder_.path("key.pem")));
  expect_trouble_with("key.pem", "directory");
}

}  // namespace
}  // namespace kcs::security
