#include "tests/cluster/cluster.h"

#include <fmt/format.h>
#include <grpcpp/grpcpp.h>
#include <httplib.h>
#include <kcs/v1/machine.grpc.pb.h>
#include <signal.h>

#include <algorithm>
#include <chrono>
#include <fstream>
#include <stdexcept>
#include <thread>

#include "tests/cluster/balancer_file.h"
#include "tests/system/free_port.h"

namespace kcs::test {
namespace {

namespace fs = std::filesystem;
using std::chrono::steady_clock;

constexpr std::chrono::seconds kPatience{60};

std::string loopback() { return fmt::format("127.0.0.1:{}", free_port()); }

std::string port_of(const std::string& address) { return address.substr(address.rfind(':') + 1); }

}  // namespace

std::optional<std::string> Cluster::missing() {
  if (!fs::exists(kHaproxy)) return "haproxy is not installed";
  if (!fs::exists("/usr/lib/postgresql")) return "postgresql is not installed";
  return std::nullopt;
}

Cluster::Cluster(std::size_t places)
    : settings_(folder_.path() / "kcsd.toml"), places_(places), address_(loopback()), figures_address_(loopback()) {
  std::ofstream(settings_) << fmt::format(
      "[store]\ndatabase = \"{}\"\npassword_file = \"{}\"\nlease_s = 1.0\n"
      "[connections]\nlongest_age_s = 0.0\n",
      postgres_.create_database("plans"), postgres_.password_file().string());
  for (Place& place : places_) place = {.address = loopback(), .http_address = loopback(), .kcsd = nullptr};
  balancer_ =
      std::make_unique<ChildProcess>(std::vector<std::string>{kHaproxy, "-db", "-f", write_balancer().string()});
}

// The shipped one, with the addresses of these servers instead of names of containers.
fs::path Cluster::write_balancer() const {
  std::string text = shipped_balancer("compose"), servers;
  for (std::size_t i = 0; i < places_.size(); ++i) {
    servers += fmt::format("  server kcsd{} {} port {}\n", i, places_[i].address, port_of(places_[i].http_address));
  }
  replace(text, "  server-template kcsd 10 kcsd:50551\n", servers);
  replace(text, "maxconn 20000", "maxconn 2000");  // what any machine has files for
  replace(text, " port 50552", "");
  replace(text, " resolvers containers init-addr none", "");
  replace(text, "resolvers containers\n  parse-resolv-conf\n  hold valid 5s\n", "");
  replace(text, "bind :50551", "bind " + address_);
  replace(text, "bind :8404", "bind " + figures_address_);
  const fs::path file = folder_.path() / "haproxy.cfg";
  std::ofstream(file) << text;
  return file;
}

bool Cluster::is_up(std::size_t place) const {
  httplib::Client client("http://" + figures_address_);
  const auto figures = client.Get("/metrics");
  const auto up_in = [&](const char* backend) {
    return figures &&
           figures->body.find(fmt::format("haproxy_server_status{{proxy=\"{}\",server=\"kcsd{}\",state=\"UP\"}} 1",
                                          backend, place)) != std::string::npos;
  };
  return up_in("servers") && up_in("machines");
}

void Cluster::start(std::size_t place) {
  Place& it = places_.at(place);
  it.kcsd = std::make_unique<KcsdProcess>(std::vector<std::string>{KCSD, "--config", settings_.string(), "--listen",
                                                                   it.address, "--http-listen", it.http_address});
  for (const auto end = steady_clock::now() + kPatience; !is_up(place);) {
    if (steady_clock::now() > end)
      throw std::runtime_error("the balancer does not see a server:\n" + balancer_->errors());
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  }
}

void Cluster::kill(std::size_t place) {
  process(place).send_signal(SIGKILL);
  process(place).wait();
  places_[place].kcsd.reset();
}

int Cluster::drain(std::size_t place) {
  process(place).send_signal(SIGTERM);
  const int code = process(place).wait();
  places_[place].kcsd.reset();
  return code;
}

double Cluster::cpu_seconds() const {
  double sum = 0;
  for (const Place& place : places_) sum += place.kcsd ? place.kcsd->cpu_seconds() : 0;
  return sum;
}

std::string Cluster::log() const {
  std::string log;
  for (std::size_t i = 0; i < places_.size(); ++i) {
    if (runs(i)) log += fmt::format("{}:\n{}", places_[i].address, places_[i].kcsd->process().errors());
  }
  return log;
}

std::optional<std::size_t> Cluster::place_of(const std::string& machine) const {
  for (std::size_t i = 0; i < places_.size(); ++i) {
    if (!runs(i)) continue;
    const auto stub =
        v1::MachineService::NewStub(grpc::CreateChannel(places_[i].address, grpc::InsecureChannelCredentials()));
    grpc::ClientContext context;
    context.set_deadline(std::chrono::system_clock::now() + kPatience);
    v1::ListMachinesResponse machines;
    if (!stub->ListMachines(&context, {}, &machines).ok()) continue;
    const auto& list = machines.machines();
    if (std::any_of(list.begin(), list.end(), [&](const auto& it) { return it.hello().machine() == machine; }))
      return i;
  }
  return std::nullopt;
}

}  // namespace kcs::test
