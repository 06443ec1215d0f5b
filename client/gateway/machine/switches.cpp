#include "client/gateway/machine/switches.h"

#include <chrono>
#include <system_error>

namespace kcs::gateway {
namespace {

constexpr std::array<const char*, Switches::kCount> kNames = {"off", "hold", "drive-fault", "stuck"};
constexpr std::chrono::milliseconds kLookEvery{2};

}  // namespace

Switches::Switches(const std::filesystem::path& folder) : folder_(folder) {
  if (folder_.empty()) return;
  look();
  thread_ = std::jthread([this](const std::stop_token& stop) {
    while (!stop.stop_requested()) {
      look();
      std::this_thread::sleep_for(kLookEvery);
    }
  });
}

void Switches::look() {
  for (std::size_t i = 0; i < kNames.size(); ++i) {
    std::error_code cannot_look;  // counts as off
    on_[i] = std::filesystem::exists(folder_ / kNames[i], cannot_look);
  }
}

}  // namespace kcs::gateway
