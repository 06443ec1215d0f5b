// Certificates made by the tests: none of them is worth anything anywhere else, and none is kept.
#pragma once

#include <openssl/evp.h>
#include <openssl/x509.h>

#include <chrono>
#include <memory>
#include <string>

namespace kcs::test {

// In PEM.
struct Issued {
  std::string certificate;
  std::string key;
};

// An authority of its own, trusted by whoever is given its certificate.
class Authority {
 public:
  explicit Authority(const std::string& name);

  const std::string& certificate() const { return certificate_; }

  // A certificate for servers and clients. alternative_names: such as "DNS:localhost,IP:127.0.0.1"; empty: none.
  // It begins a day ago and ends after `validity`, which may be negative. curve: of its key.
  Issued issue(const std::string& common_name, const std::string& alternative_names = "",
               std::chrono::seconds validity = std::chrono::hours(1), const char* curve = "P-256") const;

 private:
  using Key = std::unique_ptr<EVP_PKEY, decltype(&EVP_PKEY_free)>;
  using Certificate = std::unique_ptr<X509, decltype(&X509_free)>;

  Key key_;
  Certificate root_;
  std::string certificate_;
};

// One for the server of a test, at whatever name the loopback has.
Issued issue_for_loopback(const Authority& authority, const std::string& common_name = "kcsd");

}  // namespace kcs::test
