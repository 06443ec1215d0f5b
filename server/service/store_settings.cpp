#include "server/service/store_settings.h"

namespace kcs::service {
namespace {

// A whole number of days.
TakeValue days(std::chrono::seconds& target, std::int64_t low, std::int64_t high) {
  return [&target, low, high](const toml::node& node) {
    std::int64_t count = 0;
    whole(count, low, high)(node);
    target = std::chrono::hours(24 * count);
  };
}

}  // namespace

Keys store_keys(store::StoreSettings& settings) {
  constexpr std::int64_t kMostConnections = 1000;
  constexpr double kMostWaiting = 600;
  constexpr double kLongestLease = 86'400;
  constexpr std::int64_t kMostDays = 36'500;
  constexpr std::int64_t kMostBytes = 1'000'000'000'000'000;
  return {{"database", parsed([&settings](const std::string& database) {
             store::check_database(database);
             settings.database = database;
           })},
          {"password_file", text(settings.password_file)},
          {"connections", whole(settings.connections, 1, kMostConnections)},
          {"timeout_s", seconds(settings.timeout, 1, kMostWaiting)},
          {"lease_s", seconds(settings.lease, 1, kLongestLease)},
          {"keep_days", days(settings.keep, 1, kMostDays)},
          {"keep_bytes", whole(settings.keep_bytes, 1, kMostBytes)}};
}

}  // namespace kcs::service
