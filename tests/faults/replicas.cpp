#include <fmt/format.h>
#include <signal.h>

#include <functional>
#include <stdexcept>
#include <thread>

#include "tests/cluster/cluster.h"
#include "tests/faults/service.h"

namespace kcs::faults {
namespace {

constexpr const char* kMachine = "machines/bench";
constexpr std::size_t kReplicas = 3;  // at a time; there is a place for one more

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

  void drain_and_restart(std::chrono::milliseconds down) override {
    const std::size_t place = machines_place();
    drain(place);
    std::this_thread::sleep_for(down);
    cluster_.start(place);
  }

  void exchange_another() override {
    const auto before = cluster_.place_of(kMachine);
    cluster_.start(place_where([this](std::size_t place) { return !cluster_.runs(place); }));
    drain(place_where([&](std::size_t place) { return cluster_.runs(place) && place != before; }));
    const auto after = cluster_.place_of(kMachine);
    if (before && after && before != after) throw std::runtime_error("the machine went to another server");
  }

  void pause(bool paused) override {
    if (paused) paused_ = machines_place();
    cluster_.process(paused_).send_signal(paused ? SIGSTOP : SIGCONT);
  }

  double cpu_seconds() const override { return cluster_.cpu_seconds(); }

 private:
  // While the machine is attached nowhere, the first one will do.
  std::size_t machines_place() const { return cluster_.place_of(kMachine).value_or(0); }

  std::size_t place_where(const std::function<bool(std::size_t)>& is_so) const {
    std::size_t place = 0;
    while (!is_so(place)) ++place;
    return place;
  }

  void drain(std::size_t place) {
    if (const int code = cluster_.drain(place); code != 0) {
      throw std::runtime_error(fmt::format("kcsd ended with {}", code));
    }
  }

  test::Cluster cluster_{kReplicas + 1};
  std::size_t paused_ = 0;
};

}  // namespace

std::unique_ptr<Service> replicas() { return std::make_unique<Replicas>(); }

std::optional<std::string> missing_for_replicas() { return test::Cluster::missing(); }

}  // namespace kcs::faults
