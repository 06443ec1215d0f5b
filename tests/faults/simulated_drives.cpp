#include <algorithm>
#include <array>
#include <charconv>
#include <chrono>
#include <fstream>
#include <stdexcept>
#include <string>

#include "tests/faults/drives.h"
#include "tests/files/temporary_folder.h"

namespace kcs::faults {
namespace {

class SimulatedDrives : public Drives {
 public:
  SimulatedDrives() {
    folder_.write("gateway.toml",
                  "[machine]\nname = \"bench\"\n"
                  "[simulated]\nprofile = \"machining-center\"\nfollowing_error_mm = [5, 5, 5]\n");
  }

  std::vector<std::string> gateway_command(const std::string& server) const override {
    return {KCS_GATEWAY, "attach", "--config", folder_.path("gateway.toml"),
            "--server",  server,   "--record", folder_.path("run.csv")};
  }

  bool outlive_gateway() const override { return false; }

  double now() const override {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
  }

  // Its rows are "t,x,y,z,actual_x,actual_y,actual_z,clock".
  Commands record() const override {
    std::ifstream in(folder_.path("run.csv"));
    Commands commands;
    std::string line;
    std::getline(in, line);
    while (std::getline(in, line)) {
      std::array<double, 8> cells{};
      const char* next = line.data();
      for (double& cell : cells) {
        const auto [end, error] = std::from_chars(next, line.data() + line.size(), cell);
        if (error != std::errc()) throw std::runtime_error("the recording has a row that is not whole: " + line);
        next = std::min(end + 1, static_cast<const char*>(line.data() + line.size()));
      }
      commands.push_back({{cells[1], cells[2], cells[3]}, cells[7]});
    }
    return commands;
  }

 private:
  test::TemporaryFolder folder_;
};

}  // namespace

std::unique_ptr<Drives> simulated_drives() { return std::make_unique<SimulatedDrives>(); }

}  // namespace kcs::faults
