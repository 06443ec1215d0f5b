#include "server/store/page_token.h"

#include <fmt/format.h>
#include <openssl/sha.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <string_view>

#include "server/store/errors.h"

namespace kcs::store {
namespace {

// 64 bits each, as hexadecimal digits.
constexpr std::size_t kDigestDigits = 16;
constexpr std::size_t kTimeDigits = 16;

template <typename Value>
std::string text_of(const std::optional<Value>& value) {
  return value ? fmt::format("={}", *value) : std::string();
}

std::optional<std::int64_t> count_of(const std::optional<Time>& time) {
  return time ? std::optional(std::int64_t{time->time_since_epoch().count()}) : std::nullopt;
}

// Owner and machine name come last, with a length, so that no two lists have the same description.
std::string digest(std::string_view position, const Whose& whose, const Filter& filter) {
  const std::string owner = text_of(whose);
  const std::string list =
      fmt::format("{}|{}|{}|{}|{}|{}|{}:{}{}", position,
                  text_of(filter.state ? std::optional(static_cast<int>(*filter.state)) : std::nullopt),
                  text_of(count_of(filter.created_from)), text_of(count_of(filter.created_before)),
                  text_of(filter.cycle_time_at_least), text_of(filter.cycle_time_at_most), owner.size(), owner,
                  text_of(filter.machine_name));
  std::array<unsigned char, SHA256_DIGEST_LENGTH> hash{};
  SHA256(reinterpret_cast<const unsigned char*>(list.data()), list.size(), hash.data());
  return fmt::format("{:02x}", fmt::join(hash.begin(), hash.begin() + kDigestDigits / 2, ""));
}

}  // namespace

std::string page_token(const PageEnd& end, const Whose& whose, const Filter& filter) {
  const std::string position = fmt::format("{:016x}{}", end.create_time.time_since_epoch().count(), end.name);
  return digest(position, whose, filter) + position;
}

PageEnd parse_page_token(const std::string& token, const Whose& whose, const Filter& filter) {
  const auto position = std::string_view(token).substr(std::min(token.size(), kDigestDigits));
  std::int64_t count = 0;
  const bool ours =
      token.size() > kDigestDigits + kTimeDigits && token == digest(position, whose, filter) + std::string(position);
  if (!ours || std::from_chars(position.data(), position.data() + kTimeDigits, count, 16).ec != std::errc()) {
    throw InvalidPageToken(
        "is not the next_page_token of an answer to the same filter: leave it empty to start again from the first "
        "page");
  }
  return {.create_time = Time(std::chrono::microseconds(count)), .name = std::string(position.substr(kTimeDigits))};
}

}  // namespace kcs::store
