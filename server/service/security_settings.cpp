#include "server/service/security_settings.h"

#include <algorithm>
#include <initializer_list>
#include <iterator>
#include <stdexcept>
#include <string_view>
#include <utility>

#include "server/service/printable.h"

namespace kcs::service {
namespace {

constexpr std::size_t kLongestName = 200;

TakeValue name(std::string& target) {
  return parsed([&target](const std::string& value) {
    if (value.empty() || value != printable(value, kLongestName)) {
      throw std::runtime_error("must be a name of 1 to " + std::to_string(kLongestName) +
                               " bytes, without control characters");
    }
    target = value;
  });
}

TakeValue roles(security::Roles& target) {
  return [&target](const toml::node& node) {
    const toml::array* names = node.as_array();
    if (names == nullptr || names->empty())
      refuse_value(node, "must be a list of roles, such as [\"plan\", \"stream\"]");
    for (const toml::node& entry : *names) {
      parsed([&target](const std::string& role) { target.add(security::role_named(role)); })(entry);
    }
  };
}

// [[name]] tables, each of them with all the keys of `required`.
TakeValue complete_tables(const std::string& table, std::initializer_list<std::string_view> required,
                          std::function<Keys()> begin) {
  return [read = tables_of(table, std::move(begin)), keys = std::vector(required), table](const toml::node& node) {
    read(node);
    for (const toml::node& entry : *node.as_array()) {
      for (const std::string_view key : keys) {
        if (!entry.as_table()->contains(key)) refuse_value(entry, fmt::format("[[{}]] must say \"{}\"", table, key));
      }
    }
  };
}

// The hash of the last of `tokens`; none of those before it has the same.
TakeValue hash(std::vector<security::KnownToken>& tokens) {
  return parsed([&tokens](const std::string& text) {
    tokens.back().hash = security::TokenHash::parse(text);
    const auto is_same = [&tokens](const auto& token) { return token.hash == tokens.back().hash; };
    if (std::any_of(tokens.begin(), std::prev(tokens.end()), is_same)) {
      throw std::runtime_error("stands here for the second time: say all about a token in one place");
    }
  });
}

TakeValue token_tables(std::vector<security::KnownToken>& tokens) {
  return complete_tables("tokens", {"hash", "owner", "roles"}, [&tokens]() -> Keys {
    security::KnownToken& token = tokens.emplace_back();
    return {{"hash", hash(tokens)}, {"owner", name(token.caller.owner)}, {"roles", roles(token.caller.roles)}};
  });
}

TakeValue certificate_tables(std::vector<security::KnownCertificate>& certificates) {
  return complete_tables("certificates", {"name", "owner", "roles"}, [&certificates]() -> Keys {
    security::KnownCertificate& certificate = certificates.emplace_back();
    return {{"name", name(certificate.name)},
            {"owner", name(certificate.caller.owner)},
            {"roles", roles(certificate.caller.roles)}};
  });
}

}  // namespace

Keys security_tables(SecuritySettings& settings) {
  Keys keys = {{"certificate", text(settings.tls.certificate)},
               {"key", text(settings.tls.key)},
               {"client_ca", text(settings.tls.client_ca)},
               {"tokens_file", text(settings.tokens_file)},
               {"insecure", flag(settings.insecure)}};
  return {{"security", table_of("security", std::move(keys))},
          {"tokens", token_tables(settings.tokens)},
          {"certificates", certificate_tables(settings.certificates)}};
}

std::vector<security::KnownToken> parse_tokens(const std::string& text, const std::string& file) {
  std::vector<security::KnownToken> tokens;
  read_tables(text, file, {{"tokens", token_tables(tokens)}});
  return tokens;
}

}  // namespace kcs::service
