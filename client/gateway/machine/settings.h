// What `kcs-gateway attach` is told by its file: deploy/gateway.toml says it all, with the defaults.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "client/gateway/player/player.h"
#include "client/sdk/connection.h"
#include "client/sdk/settings_error.h"

namespace kcs::gateway {

enum class Driver {
  kSimulated,  // drives inside this process
  kHal         // LinuxCNC's HAL: the component ticks, in its own process
};

struct StreamSettings {
  double batch_s = 0.02;   // motion in a batch
  double window_s = 0.25;  // motion that the server sends ahead of what is played
  double commit_s = 0.04;  // of it with the player, where it cannot be replaced any more
  double report_s = 0.02;  // between two reports while a run is on
};

struct SimulatedSettings {
  kcs_player_profile profile{};    // the machine's limits and the drives' period
  double clock_drift_ppm = 0;      // how much faster the drives' clock runs than the computer's
  std::vector<double> start_mm;    // where the drives stand at first, one per axis
  std::filesystem::path switches;  // see Switches; empty: none
};

struct Settings {
  std::string machine;  // "machines/NAME"
  Driver driver = Driver::kSimulated;
  client::Connection server;
  StreamSettings stream;
  SimulatedSettings simulated;  // of the simulated driver
  std::string hal_component;    // of the HAL driver
};

// Throws client::SettingsError.
Settings read_settings(const std::filesystem::path& file);
// The same from text; `source` stands for the file's name in errors.
Settings parse_settings(std::string_view text, const std::string& source);

}  // namespace kcs::gateway
