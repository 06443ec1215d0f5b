#include <fcntl.h>
#include <fmt/format.h>
#include <sys/mman.h>
#include <unistd.h>

#include <filesystem>
#include <memory>
#include <stdexcept>

#include "client/gateway/player/player.h"
#include "tests/faults/drives.h"
#include "tests/files/temporary_folder.h"
#include "tests/system/hal_machine.h"

namespace kcs::faults {
namespace {

namespace fs = std::filesystem;

constexpr double kPeriod = 0.001;  // s, of simulation.hal

class HalDrives : public Drives {
 public:
  HalDrives() : memory_(open_memory(machine_.file("/dev/shm/kcs-simulation"))) {
    // Where HAL's user may read it.
    fs::permissions(folder_.path(), fs::perms::all);
    fs::copy_file(KCS_GATEWAY, folder_.path("kcs-gateway"));
    folder_.write("gateway.toml", "[machine]\nname = \"bench\"\ndriver = \"hal\"\n[hal]\ncomponent = \"simulation\"\n");
  }

  std::vector<std::string> gateway_command(const std::string& server) const override {
    return machine_.inside(
        {folder_.path("kcs-gateway"), "attach", "--config", folder_.path("gateway.toml"), "--server", server});
  }

  bool outlive_gateway() const override { return true; }

  // The periods that the player has counted: HAL's samples are numbered by them.
  double now() const override { return static_cast<double>(ticks()) * kPeriod; }

  Commands record() const override {
    Commands commands;
    unsigned long next = 0;
    for (const test::HalSample& sample : machine_.record_until(ticks())) {
      if (!commands.empty() && sample.tick != next) {
        throw std::runtime_error(fmt::format("HAL's sampler lost what comes before tick {}: the record is void", next));
      }
      next = sample.tick + 1;
      commands.push_back({{sample.command_mm[0], sample.command_mm[1], sample.command_mm[2]},
                          static_cast<double>(sample.tick) * kPeriod});
    }
    return commands;
  }

 private:
  using Memory = std::shared_ptr<const kcs_player_memory>;

  static Memory open_memory(const fs::path& file) {
    const int descriptor = open(file.c_str(), O_RDONLY | O_CLOEXEC);
    void* address = mmap(nullptr, sizeof(kcs_player_memory), PROT_READ, MAP_SHARED, descriptor, 0);
    close(descriptor);
    if (address == MAP_FAILED) throw std::runtime_error(file.string() + " cannot be mapped");
    return {static_cast<const kcs_player_memory*>(address),
            [address](const kcs_player_memory*) { munmap(address, sizeof(kcs_player_memory)); }};
  }

  std::uint64_t ticks() const {
    kcs_player_report report{};
    while (!kcs_player_read(memory_.get(), &report)) {
    }
    return report.ticks;
  }

  test::TemporaryFolder folder_;
  test::HalMachine machine_;
  Memory memory_;
};

}  // namespace

std::unique_ptr<Drives> hal_drives() { return std::make_unique<HalDrives>(); }

std::optional<std::string> missing_for_hal() { return test::HalMachine::missing(); }

}  // namespace kcs::faults
