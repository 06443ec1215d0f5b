// kcsctl: plans G-code programs from the command line.
#include <spdlog/spdlog.h>

#include "client/cli/commands.h"
#include "client/cli/options.h"
#include "client/common/failure_report.h"

int main(int argc, char** argv) {
  spdlog::set_level(spdlog::level::off);  // what the service inside would log is reported below
  kcs::cli::Options options;
  if (const auto message = kcs::cli::parse_command_line(argc, argv, options)) return kcs::client::print(*message);
  return kcs::client::run_and_report("kcsctl", options.file, [&options] {
    kcs::cli::run_command(options);
    return kcs::client::kDone;
  });
}
