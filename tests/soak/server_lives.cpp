#include "tests/soak/server_lives.h"

#include <arpa/inet.h>
#include <fmt/format.h>
#include <httplib.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <fstream>
#include <random>
#include <sstream>
#include <stdexcept>

namespace kcs::soak {
namespace {

// Clients may take so long to notice that their connection is gone, on a busy machine.
constexpr std::chrono::seconds kAfterwards{5};

// A port that nobody uses, below those that connections get at their other end: while the server is away, a client
// that knocks there must not take the port itself.
int free_port() {
  std::random_device random;
  std::uniform_int_distribution ports(10'000, 30'000);
  for (int attempt = 0; attempt < 100; ++attempt) {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    address.sin_port = htons(static_cast<std::uint16_t>(ports(random)));
    const int probe = socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
    const bool is_free = bind(probe, reinterpret_cast<const sockaddr*>(&address), sizeof(address)) == 0;
    close(probe);
    if (is_free) return ntohs(address.sin_port);
  }
  throw std::runtime_error("no port is free");
}

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
    : address_(fmt::format("127.0.0.1:{}", free_port())),
      http_address_(fmt::format("127.0.0.1:{}", free_port())),
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
