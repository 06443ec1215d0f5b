// Machine profiles: TOML files that say which axes a machine has and what they can do.
//
//   [machine]
//   name = "CNC router"                     # optional
//   axes = 3                                # 2 (X, Y) or 3 (X, Y, Z)
//   [limits]                                # one number per axis
//   velocity_mm_s = [200, 200, 100]
//   acceleration_mm_s2 = [1000, 1000, 600]
//   jerk_mm_s3 = [20000, 20000, 12000]
//   rapid_mm_s = 160                        # optional: path speed of rapid moves
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>

#include "client/sdk/machine.h"
#include "client/sdk/settings_error.h"

namespace kcs::client {

// A profile that cannot be used.
using ProfileError = SettingsError;

// Reads a profile. Throws ProfileError if the file cannot be read, is not TOML, or does not say just what is wanted: a
// key that is missing, unknown or of the wrong kind is an error, never passed over.
Machine read_machine_profile(const std::filesystem::path& file);

// The same from text; `source` stands for the file's name in errors.
Machine parse_machine_profile(std::string_view text, std::string_view source);

// A profile that comes with kcs (deploy/machines). It is compiled in, so it is at hand wherever the program runs.
struct ShippedProfile {
  std::string_view name;  // "router"
  std::string_view text;
};

// All of them, by name in alphabetical order.
std::span<const ShippedProfile> shipped_profiles();

// The machine of the shipped profile that is called `profile`, otherwise of the profile in the file of that name.
// Throws ProfileError.
Machine find_machine(const std::string& profile);

}  // namespace kcs::client
