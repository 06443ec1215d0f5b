// kcsd, the planning server: flags, wiring, signals.
#include <fmt/core.h>
#include <signal.h>
#include <spdlog/spdlog.h>

#include <CLI/CLI.hpp>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <iostream>
#include <map>
#include <optional>
#include <string>

#include "client/sdk/machine_profile.h"
#include "server/security/token_commands.h"
#include "server/service/config.h"
#include "server/service/logging.h"
#include "server/service/server.h"
#include "server/store/schema_command.h"
#include "server/systemd/service_manager.h"
#include "server/version/version.h"

namespace {

using kcs::service::Config;

// What the command line says; it wins over the configuration file.
struct Flags {
  std::string config_file;
  std::optional<std::string> listen;
  std::optional<std::size_t> threads;
  std::optional<std::string> database;
  std::optional<std::string> http_listen;
  std::optional<std::string> log_level;
  std::optional<std::string> log_format;
  bool insecure = false;
  std::optional<int> schema;
  bool new_token = false;
  bool hash_token = false;
};

Config settings(const Flags& flags) {
  Config config = flags.config_file.empty() ? Config() : kcs::service::load_config(flags.config_file);
  if (flags.listen) config.server.listen = *flags.listen;
  if (flags.threads) config.server.planning_threads = *flags.threads;
  if (flags.database) config.server.store.database = *flags.database;
  if (flags.http_listen) config.server.observe.http_listen = *flags.http_listen;
  if (flags.log_level) config.log_level = kcs::service::parse_log_level(*flags.log_level);
  if (flags.log_format) config.server.observe.log_format = kcs::service::parse_log_format(*flags.log_format);
  config.server.security.insecure = config.server.security.insecure || flags.insecure;
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

// Waits for one of the signals, and meanwhile tells systemd that the program lives, if that wants to know.
int wait_for(const sigset_t& signals) {
  const auto watchdog = kcs::systemd::watchdog_period();
  if (!watchdog) {
    int signal = 0;
    sigwait(&signals, &signal);
    return signal;
  }
  const auto pause = std::chrono::nanoseconds(*watchdog) / 2;
  const auto whole = std::chrono::duration_cast<std::chrono::seconds>(pause);
  const timespec patience{.tv_sec = whole.count(), .tv_nsec = (pause - whole).count()};
  while (true) {
    kcs::systemd::tell_alive();
    const int signal = sigtimedwait(&signals, nullptr, &patience);
    if (signal > 0) return signal;
  }
}

// The machines that come with kcs, as the contract has them.
std::map<std::string, kcs::v1::Machine> shipped_machines() {
  std::map<std::string, kcs::v1::Machine> machines;
  for (const auto& [name, text] : kcs::client::shipped_profiles()) {
    const kcs::client::Machine profile = kcs::client::parse_machine_profile(text, name);
    kcs::v1::Machine& machine = machines[std::string(name)];
    machine.set_name(profile.name);
    machine.set_axes(static_cast<std::uint32_t>(profile.axes));
    machine.mutable_velocity_mm_s()->Assign(profile.velocity_mm_s.begin(), profile.velocity_mm_s.end());
    machine.mutable_acceleration_mm_s2()->Assign(profile.acceleration_mm_s2.begin(), profile.acceleration_mm_s2.end());
    machine.mutable_jerk_mm_s3()->Assign(profile.jerk_mm_s3.begin(), profile.jerk_mm_s3.end());
    if (profile.rapid_mm_s) machine.set_rapid_mm_s(*profile.rapid_mm_s);
  }
  return machines;
}

[[noreturn]] void serve(const Config& config) {
  const sigset_t signals = block_stop_signals();
  kcs::service::Server server(config.server);
  spdlog::info("kcsd {} listens on {}", kcs::version_and_build(), server.address());
  std::printf("kcsd listens on %s\n", server.address().c_str());
  std::fflush(stdout);
  if (!server.http_address().empty()) spdlog::info("shows its figures on http://{}/metrics", server.http_address());
  kcs::systemd::tell_ready("serves on " + server.address());
  const int signal = wait_for(signals);
  kcs::systemd::tell_stopping("lets running requests finish");
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
  app.set_version_flag("--version", fmt::format("kcsd {}", kcs::version_and_build()));
  app.add_option("--config", flags.config_file, "Configuration file (TOML)");
  app.add_option("--listen", flags.listen, "HOST:PORT (port 0: any free one), unix:PATH or systemd [127.0.0.1:50551]");
  app.add_option("--threads", flags.threads, "Threads that plan; 0: one for each processor [0]")
      ->check(CLI::Range(1024));
  app.add_option("--database", flags.database,
                 "sqlite, sqlite:FILE, postgresql:CONNINFO or memory: where requests and summaries are kept [sqlite]");
  app.add_option("--http-listen", flags.http_listen,
                 "HOST:PORT of /metrics, /healthz, /readyz and /v1/plans (port 0: any free one); empty: none []");
  app.add_option("--log-level", flags.log_level, "debug, info, warning, error or off [info]");
  app.add_option("--log-format", flags.log_format, "text or json [text]");
  app.add_flag("--insecure", flags.insecure, "Listen beyond this machine even without TLS, or to everybody");
  app.add_option("--schema", flags.schema,
                 "Bring the tables of the store to this version, forward or back, print what is lost; end");
  app.add_flag("--new-token", flags.new_token, "Print a new token, and to the standard error what to configure; end");
  app.add_flag("--hash-token", flags.hash_token, "Read a token from the standard input, print what to configure; end");
  CLI11_PARSE(app, argc, argv);
  try {
    if (flags.new_token) return kcs::security::make_token(std::cout, std::cerr), EXIT_SUCCESS;
    if (flags.hash_token) return kcs::security::hash_token(std::cin, std::cout), EXIT_SUCCESS;
    Config config = settings(flags);
    if (flags.schema) return kcs::store::change_schema(config.server.store, *flags.schema, std::cout), EXIT_SUCCESS;
    config.server.machines = shipped_machines();
    config.server.log = kcs::service::set_up_logging(config.log_level, config.server.observe.log_format);
    serve(config);
  } catch (const std::exception& failure) {
    std::fprintf(stderr, "kcsd: %s\n", failure.what());
    return EXIT_FAILURE;
  }
}
