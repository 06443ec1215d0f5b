#include "client/sdk/no_connection.h"

#include <fmt/core.h>

#include <array>

namespace kcs::client {
namespace {

struct Explanation {
  std::string_view sign;  // in gRPC's reason
  std::string_view meaning;
};

constexpr std::array<Explanation, 5> kWithTls = {
    {{"certificate verify failed",
      "its certificate is not trusted: it has expired, or none of the given roots stands behind it"},
     {"is not in peer certificate", "its certificate is for another name: use the name that it was issued for"},
     {"wrong version number", "it speaks no TLS: connect without, if nobody else is on the way"},
     {"Socket closed", "it breaks the connection off: it may want a client's certificate, or not trust this one's"},
     {"empty address list", "this client's certificates cannot be used: does the key belong to the certificate?"}}};

constexpr std::array<Explanation, 1> kPlain = {
    {{"Socket closed", "it breaks the connection off: it may speak TLS only"}}};

std::string_view meaning_of(std::string_view reason, bool tls) {
  const auto find = [reason](const auto& explanations) -> std::string_view {
    for (const Explanation& explanation : explanations) {
      if (reason.find(explanation.sign) != std::string_view::npos) return explanation.meaning;
    }
    return "";
  };
  return tls ? find(kWithTls) : find(kPlain);
}

}  // namespace

std::string explain_no_connection(const Connection& connection, std::string_view reason) {
  const std::string_view meaning = meaning_of(reason, connection.tls);
  if (!meaning.empty()) return fmt::format("no connection to {}: {}", connection.address, meaning);
  return fmt::format("no kcsd answers at {0}; start one with: kcsd --listen {0}", connection.address);
}

}  // namespace kcs::client
