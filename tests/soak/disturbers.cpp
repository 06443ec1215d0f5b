#include "tests/soak/disturbers.h"

#include <fmt/format.h>
#include <signal.h>

#include <cstdio>
#include <thread>

#include "tests/soak/client.h"

namespace kcs::soak {

int disturb(const std::string& address, std::uint64_t seed) {
  constexpr int kClients = 4;
  Ledger ledger;
  Tally tally([](Clock::time_point) { return true; });  // nobody tells it when the server is away
  std::vector<std::jthread> clients;
  for (int i = 0; i < kClients; ++i) {
    clients.emplace_back([&, client_seed = seed + static_cast<std::uint64_t>(i)](const std::stop_token& stop) {
      Client(address, client_seed, ledger, tally).work(stop);
    });
  }
  while (tally.faults() == 0) std::this_thread::sleep_for(std::chrono::milliseconds(10));
  fmt::print(stderr, "{}", tally.text());
  return 1;
}

void Disturbers::attend(Tally& tally) {
  for (Process& disturber : processes_) {
    if (disturber.process && Clock::now() < disturber.end) continue;
    if (disturber.process) {
      disturber.process->send_signal(SIGKILL);
      if (disturber.process->wait() != -SIGKILL) tally.fault("a client process ended: " + disturber.process->errors());
      ++killed_;
    }
    disturber.process = std::make_unique<test::ChildProcess>(
        std::vector<std::string>{"/proc/self/exe", "--disturb", address_, "--seed", std::to_string(random_())});
    disturber.end = Clock::now() + std::chrono::milliseconds(std::uniform_int_distribution(300, 4000)(random_));
  }
}

}  // namespace kcs::soak
