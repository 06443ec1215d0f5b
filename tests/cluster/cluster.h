// Several kcsd with one PostgreSQL, behind one HAProxy: deploy/compose, as processes of this machine.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "tests/cluster/balancer.h"
#include "tests/files/temporary_folder.h"
#include "tests/store/postgres_server.h"
#include "tests/system/child_process.h"
#include "tests/system/kcsd_process.h"

namespace kcs::test {

class Cluster {
 public:
  // Why there can be none here; nothing: there can.
  static std::optional<std::string> missing();

  // The balancer knows `places` servers; none of them runs yet. Throws std::runtime_error if something does not start,
  // as all of this does.
  explicit Cluster(std::size_t places);

  // Of the balancer, for clients and gateways.
  const std::string& address() const { return balancer_.address(); }

  std::size_t places() const { return servers_.size(); }
  bool runs(std::size_t place) const { return servers_[place] != nullptr; }
  // Adds a server, and waits until the balancer sends calls to it.
  void start(std::size_t place);
  // kill -9.
  void kill(std::size_t place);
  // SIGTERM, which lets it end what it does; its exit code.
  int drain(std::size_t place);
  ChildProcess& process(std::size_t place) { return servers_[place]->process(); }
  // Time that all servers that run have taken of the processors so far, s.
  double cpu_seconds() const;
  // What the servers that run have logged.
  std::string log() const;
  // The server that a machine is attached to; nothing: none.
  std::optional<std::size_t> place_of(const std::string& machine) const;

 private:
  TemporaryFolder folder_;
  PostgresServer postgres_;
  std::string settings_;
  Balancer balancer_;
  std::vector<std::unique_ptr<KcsdProcess>> servers_;  // null: does not run
};

}  // namespace kcs::test
