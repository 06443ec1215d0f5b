#include "server/service/violations.h"

#include <spdlog/fmt/fmt.h>

#include <utility>

namespace kcs::service {

void refuse(std::string field, std::string description) {
  throw planning::InvalidInput(std::vector<planning::Violation>{{std::move(field), std::move(description)}});
}

bool Violations::check_range(const std::string& field, double value, double low, double high, const char* unit) {
  if (value >= low && value <= high) return true;
  add(field, fmt::format("{} is out of range: give {} to {} {}", value, low, high, unit));
  return false;
}

}  // namespace kcs::service
