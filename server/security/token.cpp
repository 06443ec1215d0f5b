#include "server/security/token.h"

#include <openssl/crypto.h>
#include <openssl/evp.h>
#include <openssl/rand.h>

#include <algorithm>
#include <stdexcept>

namespace kcs::security {
namespace {

constexpr std::string_view kDigits = "0123456789abcdef";
constexpr std::string_view kHashPrefix = "sha256:";
constexpr std::string_view kTokenPrefix = "kcs_";  // so that tools which look for leaked secrets find it
constexpr std::string_view kTokenCharacters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789-._~+/=";
constexpr std::size_t kShortestToken = 20;

using Bytes = std::array<unsigned char, 32>;

std::string hexadecimal(const Bytes& bytes) {
  std::string text;
  for (const unsigned char byte : bytes) {
    text.push_back(kDigits[byte >> 4]);
    text.push_back(kDigits[byte & 0xf]);
  }
  return text;
}

}  // namespace

std::string new_token() {
  Bytes bytes{};
  if (RAND_bytes(bytes.data(), static_cast<int>(bytes.size())) != 1) {
    throw std::runtime_error("the system gives no random numbers; try again later");
  }
  return std::string(kTokenPrefix) + hexadecimal(bytes);
}

void require_token(std::string_view token) {
  if (token.size() < kShortestToken) {
    throw std::runtime_error("the token is too short: take at least " + std::to_string(kShortestToken) +
                             " random characters, as kcsd --new-token does");
  }
  if (token.find_first_not_of(kTokenCharacters) != std::string_view::npos) {
    throw std::runtime_error("the token has a character that is not allowed: take letters, digits and -._~+/=");
  }
}

TokenHash TokenHash::of(std::string_view token) {
  TokenHash hash;
  unsigned size = 0;
  if (EVP_Digest(token.data(), token.size(), hash.bytes_.data(), &size, EVP_sha256(), nullptr) != 1) {
    throw std::runtime_error("SHA-256 failed in the cryptographic library");
  }
  return hash;
}

TokenHash TokenHash::parse(const std::string& text) {
  TokenHash hash;
  const std::size_t size = kHashPrefix.size() + 2 * hash.bytes_.size();
  if (!text.starts_with(kHashPrefix) || text.size() != size ||
      text.find_first_not_of(kDigits, kHashPrefix.size()) != std::string::npos) {
    throw std::runtime_error(
        "must be \"sha256:\" and 64 hexadecimal digits in lower case; kcsd --hash-token makes it from a token");
  }
  for (std::size_t i = 0; i < hash.bytes_.size(); ++i) {
    const std::size_t place = kHashPrefix.size() + 2 * i;
    hash.bytes_[i] = static_cast<unsigned char>(kDigits.find(text[place]) << 4 | kDigits.find(text[place + 1]));
  }
  return hash;
}

std::string TokenHash::text() const { return std::string(kHashPrefix) + hexadecimal(bytes_); }

bool TokenHash::operator==(const TokenHash& other) const {
  return CRYPTO_memcmp(bytes_.data(), other.bytes_.data(), bytes_.size()) == 0;
}

}  // namespace kcs::security
