// Collects everything that is wrong with a request, so that its author can put it right in one go.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "server/planning/invalid_input.h"

namespace kcs::service {

// Refuses the request for one thing: throws planning::InvalidInput.
[[noreturn]] void refuse(std::string field, std::string description);

class Violations {
 public:
  // More are not told: an answer must fit into the trailer of a call.
  static constexpr std::size_t kMost = 16;

  // `field`: path of the field, with the segment inside it. `description`: what is wrong, and what to do.
  void add(std::string field, std::string description) {
    if (list_.size() < kMost) list_.push_back({std::move(field), std::move(description)});
  }

  bool full() const { return list_.size() == kMost; }

  // Throws planning::InvalidInput if there is any.
  void refuse() const {
    if (!list_.empty()) throw planning::InvalidInput(list_);
  }

  // Adds a violation unless low ≤ value ≤ high; also if value is not a number. True if it is fine.
  bool check_range(const std::string& field, double value, double low, double high, const char* unit);

 private:
  std::vector<planning::Violation> list_;
};

}  // namespace kcs::service
