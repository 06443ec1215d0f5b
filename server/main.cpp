// kcsd, the planning server: flags, wiring, signals.
#include <signal.h>
#include <spdlog/spdlog.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <optional>
#include <string>

#include "server/service/config.h"
#include "server/service/logging.h"
#include "server/service/server.h"

namespace {

using kcs::service::Config;

// What the command line says; it wins over the configuration file.
struct Flags {
  std::string config_file;
  std::optional<std::string> listen;
  std::optional<std::size_t> threads;
  std::optional<std::string> log_level;
};

Config settings(const Flags& flags) {
  Config config = flags.config_file.empty() ? Config() : kcs::service::load_config(flags.config_file);
  if (flags.listen) config.server.listen = *flags.listen;
  if (flags.threads) config.server.planning_threads = *flags.threads;
  if (flags.log_level) config.log_level = kcs::service::parse_log_level(*flags.log_level);
  return config;
}

// The signals that stop the server, blocked from here on in this thread and those it starts: serve() waits for them.
sigset_t block_stop_signals() {
  sigset_t signals;
  sigemptyset(&signals);
  sigaddset(&signals, SIGINT);
  sigaddset(&signals, SIGTERM);
  pthread_sigmask(SIG_BLOCK, &signals, nullptr);
  return signals;
}

[[noreturn]] void serve(const Config& config) {
  const sigset_t signals = block_stop_signals();
  kcs::service::Server server(config.server);
  spdlog::info("kcsd {} listens on {}", KCS_VERSION, server.address());
  std::printf("kcsd listens on %s\n", server.address().c_str());
  std::fflush(stdout);
  int signal = 0;
  sigwait(&signals, &signal);
  spdlog::info("stops on signal {}; running requests have {} ms", signal, config.grace.count());
  server.stop(config.grace);
  spdlog::info("stopped");
  // Not by way of the destructors: gRPC would wait ten more seconds for a client that takes nothing from its
  // connection, the planning threads for a plan that nobody gets. There is nothing to save.
  std::_Exit(EXIT_SUCCESS);
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("kcsd plans how a machine tool moves, and serves it over gRPC.");
  Flags flags;
  app.set_version_flag("--version", "kcsd " KCS_VERSION);
  app.add_option("--config", flags.config_file, "Configuration file (TOML)");
  app.add_option("--listen", flags.listen, "HOST:PORT (port 0: any free one) or unix:PATH [127.0.0.1:50551]");
  app.add_option("--threads", flags.threads, "Threads that plan; 0: one for each processor [0]")
      ->check(CLI::Range(1024));
  app.add_option("--log-level", flags.log_level, "debug, info, warning, error or off [info]");
  CLI11_PARSE(app, argc, argv);
  try {
    const Config config = settings(flags);
    kcs::service::set_up_logging(config.log_level);
    serve(config);
  } catch (const std::exception& failure) {
    std::fprintf(stderr, "kcsd: %s\n", failure.what());
    return EXIT_FAILURE;
  }
}
