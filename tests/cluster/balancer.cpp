#include "tests/cluster/balancer.h"

#include <fmt/format.h>
#include <httplib.h>

#include "tests/cluster/balancer_file.h"
#include "tests/system/free_port.h"

namespace kcs::test {
namespace {

std::string loopback() { return fmt::format("127.0.0.1:{}", free_port()); }

std::string port_of(const std::string& address) { return address.substr(address.rfind(':') + 1); }

}  // namespace

Balancer::Balancer(std::size_t places) : places_(places), address_(loopback()), figures_address_(loopback()) {
  for (Place& place : places_) place = {.address = loopback(), .http_address = loopback()};
  const std::string file = folder_.write("haproxy.cfg", settings());
  process_ = std::make_unique<ChildProcess>(std::vector<std::string>{kHaproxy, "-db", "-f", file});
}

// The shipped ones, with the addresses of these places instead of names of containers.
std::string Balancer::settings() const {
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
  return text;
}

bool Balancer::sends_to(std::size_t place) const {
  httplib::Client client("http://" + figures_address_);
  const auto figures = client.Get("/metrics");
  const auto up_in = [&](const char* backend) {
    return figures &&
           figures->body.find(fmt::format("haproxy_server_status{{proxy=\"{}\",server=\"kcsd{}\",state=\"UP\"}} 1",
                                          backend, place)) != std::string::npos;
  };
  return up_in("servers") && up_in("machines");
}

}  // namespace kcs::test
