// What kcs-gateway says, and its exit code, when something fails.
#pragma once

#include <exception>
#include <string>

namespace kcs::gateway {

// The first six are those of kcsctl.
enum ExitCode {
  kDone = 0,
  kRefused = 1,   // the plan, the program, the machine or an option is not accepted
  kUsage = 2,     // the command line is wrong
  kNoServer = 3,  // no server answers, or the connection broke off
  kNoFile = 4,    // a file cannot be read or written
  kDefect = 5,    // an error inside kcs
  kStarved = 6,   // no setpoint was there when one was due
};

struct Failure {
  std::string text;  // whole lines
  ExitCode exit_code = kDefect;
};

Failure describe_failure(const std::exception_ptr& failure);

}  // namespace kcs::gateway
