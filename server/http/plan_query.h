// What the query of a request says about the plan that is wanted.
#pragma once

#include <kcs/v1/planning.pb.h>

#include <map>
#include <stdexcept>
#include <string>

namespace kcs::http {

// Machines that a query may name.
using Machines = std::map<std::string, v1::Machine>;

// A query that cannot be used; what() says why, and what to do.
class InvalidQuery : public std::runtime_error {
 public:
  InvalidQuery(std::string parameter, const std::string& reason)
      : std::runtime_error(parameter + ": " + reason), parameter_(std::move(parameter)) {}

  const std::string& parameter() const { return parameter_; }

 private:
  std::string parameter_;
};

// machine=NAME, or its limits: velocity (mm/s), acceleration (mm/s²) and jerk (mm/s³), two or three numbers each, one
// per axis: velocity=200,200,100. Besides, if wanted: rapid and feed (mm/s), tolerance (mm), start (mm, one per axis).
// The ranges are the service's (planning.proto), which checks them. Throws InvalidQuery.
v1::PlanOptions options_of(const std::multimap<std::string, std::string>& query, const Machines& machines);

}  // namespace kcs::http
