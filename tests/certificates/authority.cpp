#include "tests/certificates/authority.h"

#include <openssl/ec.h>
#include <openssl/pem.h>
#include <openssl/rand.h>
#include <openssl/x509v3.h>

#include <cstdint>
#include <stdexcept>

namespace kcs::test {
namespace {

void require(bool succeeded) {
  if (!succeeded) throw std::runtime_error("OpenSSL cannot make a certificate");
}

std::string pem(const auto& write) {
  const std::unique_ptr<BIO, decltype(&BIO_free)> text(BIO_new(BIO_s_mem()), &BIO_free);
  require(write(text.get()) == 1);
  char* data = nullptr;
  const long size = BIO_get_mem_data(text.get(), &data);
  return {data, static_cast<std::size_t>(size)};
}

std::string pem_of(X509* certificate) {
  return pem([certificate](BIO* text) { return PEM_write_bio_X509(text, certificate); });
}

void add_extension(X509* certificate, int kind, const std::string& value) {
  X509_EXTENSION* extension = X509V3_EXT_conf_nid(nullptr, nullptr, kind, value.c_str());
  require(extension != nullptr && X509_add_ext(certificate, extension, -1) == 1);
  X509_EXTENSION_free(extension);
}

// Not yet signed.
X509* new_certificate(const std::string& name, EVP_PKEY* key, std::chrono::seconds validity) {
  constexpr long kDay = 24L * 3600;
  X509* certificate = X509_new();
  std::uint32_t serial = 0;
  require(RAND_bytes(reinterpret_cast<unsigned char*>(&serial), sizeof serial) == 1);
  X509_set_version(certificate, X509_VERSION_3);
  ASN1_INTEGER_set_uint64(X509_get_serialNumber(certificate), serial);
  X509_gmtime_adj(X509_getm_notBefore(certificate), -kDay);
  X509_gmtime_adj(X509_getm_notAfter(certificate), static_cast<long>(validity.count()));
  X509_NAME_add_entry_by_txt(X509_get_subject_name(certificate), "CN", MBSTRING_UTF8,
                             reinterpret_cast<const unsigned char*>(name.c_str()), -1, -1, 0);
  require(X509_set_pubkey(certificate, key) == 1);
  return certificate;
}

}  // namespace

Authority::Authority(const std::string& name)
    : key_(EVP_EC_gen("P-256"), &EVP_PKEY_free),
      root_(new_certificate(name, key_.get(), std::chrono::hours(1)), &X509_free) {
  X509_set_issuer_name(root_.get(), X509_get_subject_name(root_.get()));
  add_extension(root_.get(), NID_basic_constraints, "critical,CA:TRUE");
  require(X509_sign(root_.get(), key_.get(), EVP_sha256()) > 0);
  certificate_ = pem_of(root_.get());
}

Issued Authority::issue(const std::string& common_name, const std::string& alternative_names,
                        std::chrono::seconds validity, const char* curve) const {
  const Key key(EVP_EC_gen(curve), &EVP_PKEY_free);
  const Certificate certificate(new_certificate(common_name, key.get(), validity), &X509_free);
  X509_set_issuer_name(certificate.get(), X509_get_subject_name(root_.get()));
  if (!alternative_names.empty()) add_extension(certificate.get(), NID_subject_alt_name, alternative_names);
  require(X509_sign(certificate.get(), key_.get(), EVP_sha256()) > 0);
  return {.certificate = pem_of(certificate.get()), .key = pem([&key](BIO* text) {
                                                      return PEM_write_bio_PrivateKey(text, key.get(), nullptr, nullptr,
                                                                                      0, nullptr, nullptr);
                                                    })};
}

Issued issue_for_loopback(const Authority& authority, const std::string& common_name) {
  return authority.issue(common_name, "DNS:localhost,IP:127.0.0.1,IP:::1");
}

}  // namespace kcs::test
