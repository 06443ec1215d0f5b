#include "tests/soak/server_lives.h"

#include <fmt/format.h>
#include <httplib.h>

#include <array>
#include <fstream>
#include <sstream>
#include <stdexcept>

#include "tests/system/free_port.h"

namespace kcs::soak {
namespace {

// Clients may take so long to notice that their connection is gone, on a busy machine.
constexpr std::chrono::seconds kAfterwards{5};

std::string write_settings(const std::filesystem::path& folder) {
  const std::string file = folder / "kcsd.toml";
  // Little memory for trajectories and the database's pages: it is full within a minute, and what is asked for later is
  // planned again from the store. A short lease: what a killed server had accepted is soon planned by the next one.
  std::ofstream(file) << fmt::format(
      "[store]\ndatabase = \"sqlite:{}\"\nconnections = 3\nlease_s = 3\n"
      "[caps]\ncached_plans = 20\ncached_bytes = 33_554_432\n",
      (folder / "plans.db").string());
  return file;
}

// The value of a figure without labels.
double figure(const std::string& exposition, const std::string& name) {
  const std::size_t at = exposition.find("\n" + name + " ");
  if (at == std::string::npos) throw std::runtime_error("kcsd does not show " + name);
  return std::stod(exposition.substr(at + name.size() + 2));
}

}  // namespace

ServerLives::ServerLives(const std::filesystem::path& folder)
    : address_(fmt::format("127.0.0.1:{}", test::free_port())),
      http_address_(fmt::format("127.0.0.1:{}", test::free_port())),
      settings_(write_settings(folder)) {
  start();
}

void ServerLives::start() {
  server_ = std::make_unique<bench::ServerProcess>(
      std::vector<std::string>{"--config", settings_, "--listen", address_, "--http-listen", http_address_});
}

void ServerLives::kill_and_restart() {
  down_ = true;
  server_.reset();
  start();
  last_outage_ = Clock::now();
  down_ = false;
}

int ServerLives::stop_and_restart() {
  down_ = true;
  const int code = server_->stop();
  start();
  last_outage_ = Clock::now();
  down_ = false;
  return code;
}

bool ServerLives::outage_since(Clock::time_point since) const {
  return down_ || since < last_outage_.load() + kAfterwards;
}

Resources ServerLives::resources() const {
  httplib::Client client("http://" + http_address_);
  const auto figures = client.Get("/metrics");
  if (!figures || figures->status != 200) throw std::runtime_error("kcsd does not show its figures");
  return {.memory = figure(figures->body, "process_resident_memory_bytes"),
          .files = figure(figures->body, "process_open_fds"),
          .threads = server_->threads()};
}

}  // namespace kcs::soak
