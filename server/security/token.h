// Bearer tokens, and what a server knows of them.
#pragma once

#include <array>
#include <string>
#include <string_view>

namespace kcs::security {

// A fresh token of 256 random bits. Throws std::runtime_error if the system gives no random numbers.
std::string new_token();

// Throws std::runtime_error, without the token, if `token` has characters that no token may have (RFC 6750), or is so
// short that its hash tells it: a plain hash protects what cannot be guessed, not a password.
void require_token(std::string_view token);

// The SHA-256 of a token: enough to know it again, and of no use to whoever reads the server's configuration.
class TokenHash {
 public:
  // Throws std::runtime_error if the cryptographic library fails.
  static TokenHash of(std::string_view token);
  // From text(). Throws std::runtime_error with the remedy if it is not of that form.
  static TokenHash parse(const std::string& text);

  // "sha256:" and 64 hexadecimal digits.
  std::string text() const;

  // Takes the same time whether and wherever they differ.
  bool operator==(const TokenHash& other) const;

 private:
  std::array<unsigned char, 32> bytes_{};
};

}  // namespace kcs::security
