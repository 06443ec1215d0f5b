#include <signal.h>

#include <thread>

#include "tests/cluster/cluster.h"
#include "tests/faults/service.h"

namespace kcs::faults {
namespace {

constexpr std::size_t kReplicas = 3;

class Replicas : public Service {
 public:
  Replicas() {
    for (std::size_t place = 0; place < kReplicas; ++place) cluster_.start(place);
  }

  const std::string& address() const override { return cluster_.address(); }

  void kill_and_restart(std::chrono::milliseconds down) override {
    const std::size_t place = machines_place();
    cluster_.kill(place);
    std::this_thread::sleep_for(down);
    cluster_.start(place);
  }

  void pause(bool paused) override {
    if (paused) paused_ = machines_place();
    cluster_.process(paused_).send_signal(paused ? SIGSTOP : SIGCONT);
  }

  double cpu_seconds() const override { return cluster_.cpu_seconds(); }

 private:
  // While the machine is attached nowhere, the first one will do.
  std::size_t machines_place() const { return cluster_.place_of("machines/bench").value_or(0); }

  test::Cluster cluster_{kReplicas};
  std::size_t paused_ = 0;
};

}  // namespace

std::unique_ptr<Service> replicas() { return std::make_unique<Replicas>(); }

std::optional<std::string> missing_for_replicas() { return test::Cluster::missing(); }

}  // namespace kcs::faults
