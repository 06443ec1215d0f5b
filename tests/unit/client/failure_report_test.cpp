#include "client/common/failure_report.h"

#include <gtest/gtest.h>

#include <cerrno>
#include <system_error>

#include "client/common/file_error.h"
#include "client/sdk/error.h"
#include "client/sdk/machine_profile.h"

namespace kcs::client {
namespace {

template <typename Failure>
FailureReport report(const Failure& failure, const std::string& program = "part.ngc") {
  return describe_failure(std::make_exception_ptr(failure), "kcsctl", program);
}

Error refusal(const std::string& field) { return {"INVALID_ARGUMENT", "refused", {{field, "does not go"}}}; }

TEST(FailureReport, FaultsOfTheProgramNameFileLineAndColumn) {
  EXPECT_EQ(report(refusal("gcode, line 12, column 5")).text, "part.ngc:12:5: does not go\n");
  EXPECT_EQ(report(refusal("gcode, line 12")).text, "part.ngc:12: does not go\n");
  EXPECT_EQ(report(refusal("gcode")).text, "part.ngc: gcode: does not go\n");
  EXPECT_EQ(report(refusal("gcode, line 12, column 5"), "-").text, "<stdin>:12:5: does not go\n");
}

TEST(FailureReport, FaultsOfTheOptionsNameTheOption) {
  EXPECT_EQ(report(refusal("options.start_mm")).text, "kcsctl: options.start_mm: does not go\n");
  EXPECT_EQ(report(refusal("period_s")).text, "kcsctl: period_s: does not go\n");
}

TEST(FailureReport, OtherFailuresBeginWithTheProgramThatRuns) {
  const auto failure = std::make_exception_ptr(Error("UNAVAILABLE", "nobody there"));
  EXPECT_EQ(describe_failure(failure, "kcs-gateway", "").text, "kcs-gateway: nobody there\n");
}

TEST(FailureReport, EveryViolationHasItsLine) {
  const Error error("INVALID_ARGUMENT", "refused", {{"gcode, line 1", "a"}, {"gcode, line 2", "b"}});
  EXPECT_EQ(report(error).text, "part.ngc:1: a\npart.ngc:2: b\n");
}

TEST(FailureReport, ExitCodesTellCausesApart) {
  EXPECT_EQ(report(refusal("gcode")).exit_code, kRefused);
  EXPECT_EQ(report(Error("RESOURCE_EXHAUSTED", "too large")).exit_code, kRefused);
  EXPECT_EQ(report(Error("UNAVAILABLE", "nobody there")).exit_code, kNoServer);
  EXPECT_EQ(report(Error("INTERNAL", "not verified")).exit_code, kDefect);
  EXPECT_EQ(report(ProfileError("a.toml:1:1: bad")).exit_code, kRefused);
  EXPECT_EQ(report(FileError("a: cannot be read")).exit_code, kNoFile);
  EXPECT_EQ(report(std::system_error(ENOSPC, std::generic_category())).exit_code, kNoFile);
  EXPECT_EQ(report(std::logic_error("oops")).exit_code, kDefect);
}

}  // namespace
}  // namespace kcs::client
