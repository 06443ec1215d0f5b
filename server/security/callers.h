// By what a server knows its callers.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "server/security/identity.h"
#include "server/security/token.h"

namespace kcs::security {

// A token, and whom it stands for.
struct KnownToken {
  TokenHash hash;
  Identity caller;
};

// The name in a certificate, and whom it stands for.
struct KnownCertificate {
  std::string name;
  Identity caller;
};

// The caller of `token`, as long as the list lives; null if it is unknown. The time that it takes does not depend on
// the token, so it cannot be guessed piece by piece.
const Identity* find_caller(const std::vector<KnownToken>& known, std::string_view token);

// The caller of a certificate with these names; null if it is unknown.
const Identity* find_caller(const std::vector<KnownCertificate>& known, const std::vector<std::string>& names);

}  // namespace kcs::security
