#include "client/common/failure_report.h"

#include <fmt/core.h>

#include <cstdlib>
#include <iostream>
#include <string_view>
#include <system_error>

#include "client/common/file_error.h"
#include "client/sdk/error.h"
#include "client/sdk/machine_profile.h"

namespace kcs::client {
namespace {

ExitCode exit_code_of(const std::string& status) {
  if (status == "UNAVAILABLE" || status == "DEADLINE_EXCEEDED" || status == "CANCELLED") return kNoServer;
  if (status == "INTERNAL" || status == "UNKNOWN" || status == "DATA_LOSS") return kDefect;
  return kRefused;
}

std::string_view hint(const std::string& status) {
  return status == "UNAUTHENTICATED" ? " (--token-file FILE, or KCS_TOKEN_FILE)" : "";
}

// Where the violation is: "FILE:12:5" for "gcode, line 12, column 5".
std::string place_of(const FieldViolation& violation, const std::string& tool, const std::string& gcode_file) {
  constexpr std::string_view kLine = "gcode, line ";
  constexpr std::string_view kColumn = ", column ";
  const std::string file = gcode_file == "-" ? "<stdin>" : gcode_file;
  if (violation.field.starts_with(kLine)) {
    const std::string_view numbers = std::string_view(violation.field).substr(kLine.size());
    const std::size_t comma = numbers.find(kColumn);
    if (comma == std::string_view::npos) return fmt::format("{}:{}", file, numbers);
    return fmt::format("{}:{}:{}", file, numbers.substr(0, comma), numbers.substr(comma + kColumn.size()));
  }
  const bool in_program = violation.field.starts_with("gcode") || violation.field.starts_with("path");
  return fmt::format("{}: {}", in_program ? file : tool, violation.field);
}

FailureReport describe(const Error& error, const std::string& tool, const std::string& gcode_file) {
  FailureReport report{.text = "", .exit_code = exit_code_of(error.code())};
  for (const FieldViolation& violation : error.violations()) {
    report.text += fmt::format("{}: {}\n", place_of(violation, tool, gcode_file), violation.description);
  }
  if (report.text.empty()) report.text = fmt::format("{}: {}{}\n", tool, error.what(), hint(error.code()));
  return report;
}

}  // namespace

FailureReport describe_failure(const std::exception_ptr& failure, const std::string& tool,
                               const std::string& gcode_file) {
  const auto report = [&tool](const std::exception& error, ExitCode exit_code) {
    return FailureReport{fmt::format("{}: {}\n", tool, error.what()), exit_code};
  };
  try {
    std::rethrow_exception(failure);
  } catch (const Error& error) {
    return describe(error, tool, gcode_file);
  } catch (const ProfileError& error) {
    return {fmt::format("{}\n", error.what()), kRefused};
  } catch (const FileError& error) {
    return report(error, kNoFile);
  } catch (const std::system_error& error) {  // as the standard library's files and streams throw
    return report(error, kNoFile);
  } catch (const std::exception& error) {
    return report(error, kDefect);
  }
}

int run_and_report(const std::string& tool, const std::string& gcode_file, const std::function<ExitCode()>& work) {
  // What gRPC has to say of a connection that failed is in the report; whoever wants more says so.
  setenv("GRPC_VERBOSITY", "NONE", /*overwrite=*/0);
  try {
    return work();
  } catch (...) {
    const FailureReport report = describe_failure(std::current_exception(), tool, gcode_file);
    std::cerr << report.text;
    return report.exit_code;
  }
}

}  // namespace kcs::client
