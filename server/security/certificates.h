// The certificates of a server: from its files, checked before they are used.
#pragma once

#include <string>

namespace kcs::security {

// All in PEM.
struct CertificateFiles {
  std::string certificate;  // the server's own, then those between it and the root; empty: no TLS
  std::string key;          // of the first certificate, without a passphrase
  std::string client_ca;    // roots that clients' certificates must come from; empty: clients need none
};

// Their contents. What there is, is sound: the certificate is valid still, the key belongs to it.
struct Certificates {
  std::string certificate;
  std::string key;
  std::string client_ca;

  bool operator==(const Certificates&) const = default;
};

// Reads the files as they are now, without a check.
Certificates read_certificates(const CertificateFiles& files);

// Throws std::runtime_error, with the file's name and the remedy, if a file does not hold what it should (as when it is
// half written), if key and certificate do not belong together (as when one of them was replaced so far), or if the
// certificate is too weak or has expired.
void require_sound(const Certificates& certificates, const CertificateFiles& files);

// Whom the first certificate is for, and until when: "CN=kcs.example.com, valid until Nov 22 10:00:00 2027 GMT".
std::string describe(const Certificates& certificates);

}  // namespace kcs::security
