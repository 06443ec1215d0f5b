#include "server/security/certificates.h"

#include <openssl/bio.h>
#include <openssl/err.h>
#include <openssl/pem.h>
#include <openssl/ssl.h>
#include <openssl/x509.h>

#include <memory>
#include <stdexcept>

#include "server/security/file_content.h"

namespace kcs::security {
namespace {

using Bio = std::unique_ptr<BIO, decltype(&BIO_free)>;
using Key = std::unique_ptr<EVP_PKEY, decltype(&EVP_PKEY_free)>;
using Certificate = std::unique_ptr<X509, decltype(&X509_free)>;
using Context = std::unique_ptr<SSL_CTX, decltype(&SSL_CTX_free)>;

[[noreturn]] void refuse(const std::string& file, const std::string& what) {
  ERR_clear_error();  // this thread's next user of OpenSSL is not to find it
  throw std::runtime_error(file + ": " + what);
}

Bio reader_of(const std::string& text) {
  return {BIO_new_mem_buf(text.data(), static_cast<int>(text.size())), &BIO_free};
}

Certificate next_certificate(const Bio& text) {
  return {PEM_read_bio_X509(text.get(), nullptr, nullptr, nullptr), &X509_free};
}

Certificate first_certificate(const std::string& text) { return next_certificate(reader_of(text)); }

// All certificates of a file are read, as the end of a half written one is missing.
void require_certificates(const std::string& text, const std::string& file) {
  const Bio reader = reader_of(text);
  std::size_t count = 0;
  while (next_certificate(reader)) ++count;
  const bool at_end = ERR_GET_REASON(ERR_peek_last_error()) == PEM_R_NO_START_LINE;
  ERR_clear_error();
  if (count == 0 || !at_end) refuse(file, "must hold certificates in PEM, all of them whole");
}

Key read_key(const std::string& text) {
  // Without this OpenSSL would ask at the terminal for the passphrase of an encrypted key.
  const auto no_passphrase = [](char*, int, int, void*) { return -1; };
  return {PEM_read_bio_PrivateKey(reader_of(text).get(), nullptr, no_passphrase, nullptr), &EVP_PKEY_free};
}

std::string written(const auto& write) {
  const Bio text(BIO_new(BIO_s_mem()), &BIO_free);
  write(text.get());
  char* data = nullptr;
  const long size = BIO_get_mem_data(text.get(), &data);
  return {data, static_cast<std::size_t>(size)};
}

std::string end_of(const X509* certificate) {
  return written([certificate](BIO* text) { ASN1_TIME_print(text, X509_get0_notAfter(certificate)); });
}

}  // namespace

Certificates read_certificates(const CertificateFiles& files) {
  return {.certificate = file_content(files.certificate),
          .key = file_content(files.key),
          .client_ca = files.client_ca.empty() ? "" : file_content(files.client_ca)};
}

void require_sound(const Certificates& certificates, const CertificateFiles& files) {
  require_certificates(certificates.certificate, files.certificate);
  if (!files.client_ca.empty()) require_certificates(certificates.client_ca, files.client_ca);
  const Key key = read_key(certificates.key);
  if (!key) refuse(files.key, "must hold a private key in PEM, without a passphrase");
  const Certificate certificate = first_certificate(certificates.certificate);
  if (X509_check_private_key(certificate.get(), key.get()) != 1) {
    refuse(files.key, "is not the key of the first certificate in " + files.certificate + "; replace both together");
  }
  const Context context(SSL_CTX_new(TLS_server_method()), &SSL_CTX_free);
  if (SSL_CTX_use_certificate(context.get(), certificate.get()) != 1) {
    const char* reason = ERR_reason_error_string(ERR_peek_last_error());
    refuse(files.certificate,
           std::string("is of no use for TLS (") + (reason == nullptr ? "?" : reason) + "); make another one");
  }
  if (X509_cmp_current_time(X509_get0_notAfter(certificate.get())) < 0) {
    refuse(files.certificate, "has expired (" + end_of(certificate.get()) + "); renew it");
  }
}

std::string describe(const Certificates& certificates) {
  const Certificate certificate = first_certificate(certificates.certificate);
  const std::string subject = written([&certificate](BIO* text) {
    X509_NAME_print_ex(text, X509_get_subject_name(certificate.get()), 0, XN_FLAG_RFC2253 & ~ASN1_STRFLGS_ESC_MSB);
  });
  return subject + ", valid until " + end_of(certificate.get());
}

}  // namespace kcs::security
