#include "server/security/token_commands.h"

#include <istream>
#include <ostream>
#include <string>

#include "server/security/token.h"

namespace kcs::security {
namespace {

std::string configuration_line(const std::string& token) { return "hash = \"" + TokenHash::of(token).text() + "\"\n"; }

}  // namespace

void make_token(std::ostream& out, std::ostream& notes) {
  const std::string token = new_token();
  out << token << std::endl;
  notes << configuration_line(token);
}

void hash_token(std::istream& in, std::ostream& out) {
  std::string token;
  std::getline(in, token);
  if (token.ends_with('\r')) token.pop_back();
  require_token(token);
  out << configuration_line(token);
}

}  // namespace kcs::security
