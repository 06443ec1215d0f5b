// Why a call to the planning service failed.
#pragma once

#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace kcs::client {

// One thing that is wrong with a request.
struct FieldViolation {
  std::string field;        // where: "options.machine.jerk_mm_s3[1]", "gcode, line 12, column 5"
  std::string description;  // what is wrong, and what to do
};

// Thrown by every call of this library that the server refuses or does not answer.
class Error : public std::runtime_error {
 public:
  Error(std::string code, const std::string& message, std::vector<FieldViolation> violations = {})
      : std::runtime_error(message), code_(std::move(code)), violations_(std::move(violations)) {}

  // Name of the gRPC status code: "INVALID_ARGUMENT", "NOT_FOUND", "UNAVAILABLE", …
  const std::string& code() const { return code_; }

  // What is wrong with the request; empty if the failure is not about its content.
  const std::vector<FieldViolation>& violations() const { return violations_; }

 private:
  std::string code_;
  std::vector<FieldViolation> violations_;
};

}  // namespace kcs::client
