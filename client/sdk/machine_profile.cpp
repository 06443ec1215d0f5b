#include "client/sdk/machine_profile.h"

#include <fmt/core.h>

#include "client/sdk/toml_reader.h"

namespace kcs::client {
namespace {

class ProfileReader {
 public:
  explicit ProfileReader(std::string_view source) : reader_(std::string(source)) {}

  Machine read(std::string_view text) const {
    const toml::table root = reader_.parse(text);
    reader_.refuse_unknown(root, "", {"machine", "limits"});
    const toml::table& machine_table = reader_.section(root, "machine");
    const toml::table& limits = reader_.section(root, "limits");
    reader_.refuse_unknown(machine_table, "machine.", {"name", "axes"});
    reader_.refuse_unknown(limits, "limits.", {"velocity_mm_s", "acceleration_mm_s2", "jerk_mm_s3", "rapid_mm_s"});

    Machine machine;
    machine.axes = axes(machine_table);
    if (const toml::node* name = machine_table.get("name")) machine.name = reader_.text(*name, "machine.name");
    machine.velocity_mm_s = one_per_axis(limits, "velocity_mm_s", machine.axes);
    machine.acceleration_mm_s2 = one_per_axis(limits, "acceleration_mm_s2", machine.axes);
    machine.jerk_mm_s3 = one_per_axis(limits, "jerk_mm_s3", machine.axes);
    if (const toml::node* rapid = limits.get("rapid_mm_s")) {
      machine.rapid_mm_s = reader_.positive_number(*rapid, "limits.rapid_mm_s");
    }
    return machine;
  }

 private:
  std::size_t axes(const toml::table& machine) const {
    const toml::node* node = machine.get("axes");
    if (node == nullptr) reader_.fail(machine, "machine.axes", "is missing; add axes = 2 (X, Y) or axes = 3 (X, Y, Z)");
    if (!node->is_integer() || (node->ref<std::int64_t>() != 2 && node->ref<std::int64_t>() != 3)) {
      reader_.fail(*node, "machine.axes", "must be 2 (X, Y) or 3 (X, Y, Z)");
    }
    return static_cast<std::size_t>(node->ref<std::int64_t>());
  }

  std::vector<double> one_per_axis(const toml::table& limits, std::string_view key, std::size_t axes) const {
    const std::string full_key = fmt::format("limits.{}", key);
    const toml::node* node = limits.get(key);
    if (node == nullptr) {
      reader_.fail(limits, full_key, fmt::format("is missing; give {} numbers in brackets, one per axis", axes));
    }
    return reader_.positive_per_axis(*node, full_key, axes);
  }

  TomlReader reader_;
};

}  // namespace

Machine read_machine_profile(const std::filesystem::path& file) {
  return parse_machine_profile(read_settings_text(file, ", or name a built-in profile"), file.string());
}

Machine parse_machine_profile(std::string_view text, std::string_view source) {
  return ProfileReader(source).read(text);
}

Machine find_machine(const std::string& profile) {
  for (const ShippedProfile& shipped : shipped_profiles()) {
    if (shipped.name == profile) return parse_machine_profile(shipped.text, shipped.name);
  }
  return read_machine_profile(profile);
}

}  // namespace kcs::client
