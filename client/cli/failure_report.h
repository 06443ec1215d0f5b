// What kcsctl says when something fails.
#pragma once

#include <exception>
#include <string>

#include "client/cli/exit_code.h"

namespace kcs::cli {

struct FailureReport {
  std::string text;  // whole lines
  ExitCode exit_code = kDefect;
};

// Puts `failure` into words. What is wrong with the program comes as "FILE:LINE:COLUMN: reason", one line each, so that
// editors can jump there. `program` is the program's file name, "-" for standard input.
FailureReport describe_failure(const std::exception_ptr& failure, const std::string& program);

}  // namespace kcs::cli
