// Why a request is refused.
#pragma once

#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace kcs::planning {

// One thing that is wrong with the input.
struct Violation {
  std::string field;        // where: a field, with the segment or the line and column inside it
  std::string description;  // what is wrong, and what to do
};

// Thrown when the input cannot be planned. Carries at least one violation; what() is the first, in one sentence.
class InvalidInput : public std::runtime_error {
 public:
  explicit InvalidInput(std::vector<Violation> violations)
      : std::runtime_error(violations.at(0).field + ": " + violations.at(0).description),
        violations_(std::move(violations)) {}

  const std::vector<Violation>& violations() const { return violations_; }

 private:
  std::vector<Violation> violations_;
};

}  // namespace kcs::planning
