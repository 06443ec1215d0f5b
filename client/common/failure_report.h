// What a program says, and its exit code, when something fails.
#pragma once

#include <exception>
#include <functional>
#include <string>

#include "client/common/exit_code.h"

namespace kcs::client {

struct FailureReport {
  std::string text;  // whole lines
  ExitCode exit_code = kDefect;
};

// Puts `failure` into words. What is wrong with the G-code comes as "FILE:LINE:COLUMN: reason", one line each, so that
// editors can jump there; all else begins with the name of the running program, `tool`. `gcode_file` is the file's
// name, "-" for standard input.
FailureReport describe_failure(const std::exception_ptr& failure, const std::string& tool,
                               const std::string& gcode_file);

// Runs a program's work and returns its exit code; what the work throws is described on standard error.
int run_and_report(const std::string& tool, const std::string& gcode_file, const std::function<ExitCode()>& work);

}  // namespace kcs::client
