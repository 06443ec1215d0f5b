#include "tests/cluster/cluster.h"

#include <fmt/format.h>
#include <grpcpp/grpcpp.h>
#include <kcs/v1/machine.grpc.pb.h>
#include <signal.h>

#include <algorithm>
#include <chrono>
#include <fstream>
#include <stdexcept>
#include <thread>

#include "tests/cluster/balancer_file.h"

namespace kcs::test {
namespace {

namespace fs = std::filesystem;
using std::chrono::steady_clock;

constexpr std::chrono::seconds kPatience{60};

}  // namespace

std::optional<std::string> Cluster::missing() {
  if (!fs::exists(kHaproxy)) return "haproxy is not installed";
  if (!fs::exists("/usr/lib/postgresql")) return "postgresql is not installed";
  return std::nullopt;
}

Cluster::Cluster(std::size_t places) : settings_(folder_.path("kcsd.toml")), balancer_(places), servers_(places) {
  std::ofstream(settings_) << fmt::format(
      "[store]\ndatabase = \"{}\"\npassword_file = \"{}\"\nlease_s = 1.0\n"
      "[connections]\nlongest_age_s = 0.0\n",
      postgres_.create_database("plans"), postgres_.password_file().string());
}

void Cluster::start(std::size_t place) {
  const Balancer::Place& where = balancer_.place(place);
  servers_.at(place) = std::make_unique<KcsdProcess>(std::vector<std::string>{
      KCSD, "--config", settings_, "--listen", where.address, "--http-listen", where.http_address});
  for (const auto end = steady_clock::now() + kPatience; !balancer_.sends_to(place);) {
    if (steady_clock::now() > end)
      throw std::runtime_error("the balancer does not see a server:\n" + balancer_.errors());
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  }
}

void Cluster::kill(std::size_t place) {
  process(place).send_signal(SIGKILL);
  process(place).wait();
  servers_[place].reset();
}

int Cluster::drain(std::size_t place) {
  process(place).send_signal(SIGTERM);
  const int code = process(place).wait();
  servers_[place].reset();
  return code;
}

double Cluster::cpu_seconds() const {
  double sum = 0;
  for (const auto& server : servers_) sum += server ? server->cpu_seconds() : 0;
  return sum;
}

std::string Cluster::log() const {
  std::string log;
  for (std::size_t i = 0; i < places(); ++i) {
    if (runs(i)) log += fmt::format("{}:\n{}", balancer_.place(i).address, servers_[i]->process().errors());
  }
  return log;
}

std::optional<std::size_t> Cluster::place_of(const std::string& machine) const {
  for (std::size_t i = 0; i < places(); ++i) {
    if (!runs(i)) continue;
    const auto stub = v1::MachineService::NewStub(
        grpc::CreateChannel(balancer_.place(i).address, grpc::InsecureChannelCredentials()));
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
