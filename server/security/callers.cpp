#include "server/security/callers.h"

#include <algorithm>

namespace kcs::security {

const Identity* find_caller(const std::vector<KnownToken>& known, std::string_view token) {
  const TokenHash hash = TokenHash::of(token);
  const Identity* caller = nullptr;
  for (const KnownToken& entry : known) {
    if (entry.hash == hash) caller = &entry.caller;
  }
  return caller;
}

const Identity* find_caller(const std::vector<KnownCertificate>& known, const std::vector<std::string>& names) {
  const auto found = std::find_if(known.begin(), known.end(), [&names](const KnownCertificate& entry) {
    return std::find(names.begin(), names.end(), entry.name) != names.end();
  });
  return found == known.end() ? nullptr : &found->caller;
}

}  // namespace kcs::security
