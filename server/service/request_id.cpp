#include "server/service/request_id.h"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cstdint>
#include <random>
#include <string_view>

namespace kcs::service {
namespace {

constexpr std::size_t kMostLength = 128;

// Whether it may stand in a log and in metadata as it is.
bool is_sane(std::string_view id) {
  constexpr std::string_view kPunctuation = "-._:/+=@";
  return !id.empty() && id.size() <= kMostLength && std::all_of(id.begin(), id.end(), [&](char c) {
    return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') ||
           kPunctuation.find(c) != std::string_view::npos;
  });
}

std::string random_id() {
  std::random_device random;
  const auto half = [&random] { return std::uint64_t{random()} << 32 | random(); };
  return fmt::format("{:016x}{:016x}", half(), half());
}

}  // namespace

std::string request_id_of(const grpc::ServerContext& context) {
  const auto found = context.client_metadata().find(kRequestIdKey);
  if (found != context.client_metadata().end()) {
    const std::string_view given(found->second.data(), found->second.size());
    if (is_sane(given)) return std::string(given);
  }
  return random_id();
}

}  // namespace kcs::service
