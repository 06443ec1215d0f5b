// Who may reach a server, and how it shows that it is the right one.
#pragma once

#include <string>
#include <vector>

#include "server/security/callers.h"
#include "server/security/certificates.h"

namespace kcs::service {

struct SecuritySettings {
  security::CertificateFiles tls;
  // Whoever has one of these tokens, or of those in the file, or one of these certificates, may call. Without any of
  // them everybody may, and does everything.
  std::vector<security::KnownToken> tokens;
  std::string tokens_file;  // read again when it changes; empty: none
  std::vector<security::KnownCertificate> certificates;
  // Listen where others can reach the server, even without TLS or to everybody.
  bool insecure = false;

  bool tells_callers_apart() const { return !tokens.empty() || !tokens_file.empty() || !certificates.empty(); }
};

// Throws std::runtime_error with the remedy where settings contradict each other, where nobody can listen, and where a
// server that listens there would let strangers in. If it is told to be insecure it does, and the log says so.
void require_safe(const SecuritySettings& settings, const std::string& listen);

}  // namespace kcs::service
