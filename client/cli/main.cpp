// kcsctl: plans G-code programs from the command line.
#include <spdlog/spdlog.h>

#include <exception>
#include <iostream>

#include "client/cli/commands.h"
#include "client/cli/exit_code.h"
#include "client/cli/failure_report.h"
#include "client/cli/options.h"

int main(int argc, char** argv) {
  using namespace kcs::cli;
  spdlog::set_level(spdlog::level::off);  // what the service inside would log is reported below
  Options options;
  if (const auto message = parse_command_line(argc, argv, options)) {
    (message->is_error ? std::cerr : std::cout) << message->text;
    return message->is_error ? kUsage : kDone;
  }
  try {
    run_command(options);
    return kDone;
  } catch (...) {
    const FailureReport report = describe_failure(std::current_exception(), options.file);
    std::cerr << report.text;
    return report.exit_code;
  }
}
