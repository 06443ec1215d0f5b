#include "client/cli/failure_report.h"

#include <fmt/core.h>

#include <filesystem>
#include <ios>
#include <regex>

#include "client/cli/file_error.h"
#include "client/sdk/error.h"
#include "client/sdk/machine_profile.h"

namespace kcs::cli {
namespace {

ExitCode exit_code_of(const std::string& status) {
  if (status == "UNAVAILABLE" || status == "DEADLINE_EXCEEDED" || status == "CANCELLED") return kNoServer;
  if (status == "INTERNAL" || status == "UNKNOWN" || status == "DATA_LOSS") return kDefect;
  return kRefused;
}

std::string describe(const client::FieldViolation& violation, const std::string& program) {
  static const std::regex kPlace("gcode, line ([0-9]+)(, column ([0-9]+))?");
  const std::string name = program == "-" ? "<stdin>" : program;
  if (std::smatch match; std::regex_match(violation.field, match, kPlace)) {
    const std::string column = match[3].matched ? ":" + match[3].str() : "";
    return fmt::format("{}:{}{}: {}\n", name, match[1].str(), column, violation.description);
  }
  const bool in_program = violation.field.starts_with("gcode") || violation.field.starts_with("path");
  return fmt::format("{}: {}: {}\n", in_program ? name : "kcsctl", violation.field, violation.description);
}

FailureReport describe(const client::Error& error, const std::string& program) {
  FailureReport report{.text = "", .exit_code = exit_code_of(error.code())};
  for (const client::FieldViolation& violation : error.violations()) report.text += describe(violation, program);
  if (report.text.empty()) report.text = fmt::format("kcsctl: {}\n", error.what());
  return report;
}

}  // namespace

FailureReport describe_failure(const std::exception_ptr& failure, const std::string& program) {
  try {
    std::rethrow_exception(failure);
  } catch (const client::Error& error) {
    return describe(error, program);
  } catch (const client::ProfileError& error) {
    return {fmt::format("{}\n", error.what()), kRefused};
  } catch (const FileError& error) {
    return {fmt::format("kcsctl: {}\n", error.what()), kNoFile};
  } catch (const std::filesystem::filesystem_error& error) {
    return {fmt::format("kcsctl: {}\n", error.what()), kNoFile};
  } catch (const std::ios_base::failure& error) {
    return {fmt::format("kcsctl: {}\n", error.what()), kNoFile};
  } catch (const std::exception& error) {
    return {fmt::format("kcsctl: {}\n", error.what()), kDefect};
  }
}

}  // namespace kcs::cli
