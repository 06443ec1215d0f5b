#include "server/service/access_control.h"

#include <algorithm>
#include <cctype>
#include <optional>
#include <string>

#include "server/service/permissions.h"
#include "server/service/printable.h"
#include "server/service/status.h"

namespace kcs::service {
namespace {

constexpr std::size_t kMostNameBytes = 200;

// The token of a call. Throws Unauthenticated if there are two, or something else in its place.
std::optional<std::string> token_of(const grpc::ServerContext& context) {
  constexpr std::string_view kScheme = "bearer ";  // in whatever case
  const auto [first, last] = context.client_metadata().equal_range("authorization");
  if (first == last) return std::nullopt;
  const std::string value(first->second.begin(), first->second.end());
  const auto same_letter = [](char a, char b) { return a == std::tolower(static_cast<unsigned char>(b)); };
  const bool is_bearer =
      value.size() > kScheme.size() && std::equal(kScheme.begin(), kScheme.end(), value.begin(), same_letter);
  if (!is_bearer || std::next(first) != last) {
    throw Unauthenticated("the metadata \"authorization\" must be there once and be \"Bearer TOKEN\"");
  }
  return value.substr(kScheme.size());
}

// The names for which the connection's certificate was issued: the alternative ones, or the common name if there are
// none. Empty if the client showed none.
std::vector<std::string> certificate_names(const grpc::ServerContext& context) {
  std::vector<std::string> names;
  for (const grpc::string_ref& name : context.auth_context()->GetPeerIdentity()) {
    names.emplace_back(name.begin(), name.end());
  }
  return names;
}

}  // namespace

AccessControl::AccessControl(const SecuritySettings& settings)
    : tells_callers_apart_(settings.tells_callers_apart()),
      tokens_(settings.tokens),
      tokens_file_(settings.tokens_file.empty() ? nullptr : std::make_unique<TokensFile>(settings.tokens_file)),
      certificates_(settings.certificates) {}

security::Identity AccessControl::authenticate(const grpc::ServerContext& context) const {
  if (!tells_callers_apart_) return security::anybody();
  if (const std::optional<std::string> token = token_of(context)) return caller_of_token(*token);
  const std::vector<std::string> names = certificate_names(context);
  if (const security::Identity* caller = security::find_caller(certificates_, names)) return *caller;
  if (names.empty() || certificates_.empty()) {
    throw Unauthenticated("this server wants a token: send it with each call as \"authorization: Bearer TOKEN\"");
  }
  throw Unauthenticated("the certificate of " + printable(names.front(), kMostNameBytes) +
                        " is not among those that this server knows: ask its operator to add it, or send a token");
}

security::Identity AccessControl::admit(const grpc::ServerContext& context, std::string_view method) const {
  security::Identity caller = authenticate(context);
  require_permission(caller, method);
  return caller;
}

security::Identity AccessControl::caller_of_token(std::string_view token) const {
  if (const security::Identity* caller = security::find_caller(tokens_, token)) return *caller;
  if (tokens_file_) {
    const TokensFile::Tokens tokens = tokens_file_->tokens();
    if (const security::Identity* caller = security::find_caller(*tokens, token)) return *caller;
  }
  throw Unauthenticated("this server does not know the token, or no longer: ask its operator for another one");
}

}  // namespace kcs::service
