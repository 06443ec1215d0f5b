#include "client/gateway/failure.h"

#include <fmt/core.h>

#include <system_error>

#include "client/sdk/error.h"
#include "client/sdk/machine_profile.h"

namespace kcs::gateway {
namespace {

ExitCode exit_code_of(const std::string& status) {
  if (status == "UNAVAILABLE" || status == "DEADLINE_EXCEEDED" || status == "CANCELLED") return kNoServer;
  if (status == "INTERNAL" || status == "UNKNOWN" || status == "DATA_LOSS") return kDefect;
  return kRefused;
}

Failure describe(const client::Error& error) {
  Failure failure = {.text = "", .exit_code = exit_code_of(error.code())};
  for (const client::FieldViolation& violation : error.violations()) {
    failure.text += fmt::format("kcs-gateway: {}: {}\n", violation.field, violation.description);
  }
  if (failure.text.empty()) failure.text = fmt::format("kcs-gateway: {}\n", error.what());
  return failure;
}

}  // namespace

Failure describe_failure(const std::exception_ptr& failure) {
  try {
    std::rethrow_exception(failure);
  } catch (const client::Error& error) {
    return describe(error);
  } catch (const client::ProfileError& error) {
    return {fmt::format("kcs-gateway: {}\n", error.what()), kRefused};
  } catch (const std::system_error& error) {
    return {fmt::format("kcs-gateway: {}\n", error.what()), kNoFile};
  } catch (const std::exception& error) {
    return {fmt::format("kcs-gateway: {}\n", error.what()), kDefect};
  }
}

}  // namespace kcs::gateway
