#include "client/sdk/machine_profile.h"

#include <fmt/core.h>
#include <toml++/toml.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <initializer_list>
#include <iterator>

namespace kcs::client {
namespace {

// Takes a profile apart and says where something is wrong with it.
class ProfileReader {
 public:
  explicit ProfileReader(std::string_view source) : source_(source) {}

  Machine read(const toml::table& root) const {
    refuse_unknown(root, "", {"machine", "limits"});
    const toml::table& machine_table = section(root, "machine");
    const toml::table& limits = section(root, "limits");
    refuse_unknown(machine_table, "machine.", {"name", "axes"});
    refuse_unknown(limits, "limits.", {"velocity_mm_s", "acceleration_mm_s2", "jerk_mm_s3", "rapid_mm_s"});

    Machine machine;
    machine.axes = axes(machine_table);
    if (const toml::node* name = machine_table.get("name")) {
      if (!name->is_string()) fail(*name, "machine.name", "is not text; put it in double quotes");
      machine.name = name->ref<std::string>();
    }
    machine.velocity_mm_s = one_per_axis(limits, "velocity_mm_s", machine.axes);
    machine.acceleration_mm_s2 = one_per_axis(limits, "acceleration_mm_s2", machine.axes);
    machine.jerk_mm_s3 = one_per_axis(limits, "jerk_mm_s3", machine.axes);
    if (const toml::node* rapid = limits.get("rapid_mm_s")) {
      machine.rapid_mm_s = positive_number(*rapid, "limits.rapid_mm_s");
    }
    return machine;
  }

  [[noreturn]] void fail(const toml::source_region& place, std::string_view key, std::string_view problem) const {
    throw ProfileError(fmt::format("{}:{}:{}: {}{}{}", source_, place.begin.line, place.begin.column, key,
                                   key.empty() ? "" : " ", problem));
  }

 private:
  [[noreturn]] void fail(const toml::node& node, std::string_view key, std::string_view problem) const {
    fail(node.source(), key, problem);
  }

  void refuse_unknown(const toml::table& table, std::string_view prefix,
                      std::initializer_list<std::string_view> known) const {
    for (const auto& [key, value] : table) {
      if (std::find(known.begin(), known.end(), key.str()) != known.end()) continue;
      std::string names;
      for (const std::string_view name : known) names += (names.empty() ? "" : ", ") + std::string(name);
      fail(key.source(), fmt::format("{}{}", prefix, key.str()), "is not a known key; here can be: " + names);
    }
  }

  const toml::table& section(const toml::table& root, std::string_view key) const {
    const toml::node* node = root.get(key);
    if (node == nullptr) fail(root, key, fmt::format("is missing; add a section [{}]", key));
    if (!node->is_table()) fail(*node, key, fmt::format("is not a section; write it as [{}]", key));
    return *node->as_table();
  }

  std::size_t axes(const toml::table& machine) const {
    const toml::node* node = machine.get("axes");
    if (node == nullptr) fail(machine, "machine.axes", "is missing; add axes = 2 (X, Y) or axes = 3 (X, Y, Z)");
    if (!node->is_integer() || (node->ref<std::int64_t>() != 2 && node->ref<std::int64_t>() != 3)) {
      fail(*node, "machine.axes", "must be 2 (X, Y) or 3 (X, Y, Z)");
    }
    return static_cast<std::size_t>(node->ref<std::int64_t>());
  }

  std::vector<double> one_per_axis(const toml::table& limits, std::string_view key, std::size_t axes) const {
    const std::string full_key = fmt::format("limits.{}", key);
    const std::string remedy = fmt::format("give {} numbers in brackets, one per axis", axes);
    const toml::node* node = limits.get(key);
    if (node == nullptr) fail(limits, full_key, "is missing; " + remedy);
    const toml::array* array = node->as_array();
    if (array == nullptr) fail(*node, full_key, "is not an array; " + remedy);
    if (array->size() != axes) {
      fail(*node, full_key, fmt::format("has {} entries for {} axes; {}", array->size(), axes, remedy));
    }
    std::vector<double> numbers;
    for (const toml::node& entry : *array) {
      numbers.push_back(positive_number(entry, fmt::format("{}[{}]", full_key, numbers.size())));
    }
    return numbers;
  }

  double positive_number(const toml::node& node, std::string_view key) const {
    const double number = node.is_number() ? node.value_or(0.0) : 0.0;
    if (!(number > 0) || !std::isfinite(number)) fail(node, key, "must be a number greater than 0");
    return number;
  }

  std::string_view source_;
};

}  // namespace

Machine read_machine_profile(const std::filesystem::path& file) {
  constexpr std::uintmax_t kMostBytes = 1 << 20;  // a profile has some hundred
  std::error_code not_there;
  const bool is_profile =
      std::filesystem::is_regular_file(file, not_there) && std::filesystem::file_size(file, not_there) <= kMostBytes;
  std::ifstream stream(file, std::ios::binary);
  if (!is_profile || !stream.is_open()) {
    throw ProfileError(
        fmt::format("{}: cannot be read; check its name and permissions, or name a built-in profile", file.string()));
  }
  const std::string text{std::istreambuf_iterator<char>(stream), {}};
  return parse_machine_profile(text, file.string());
}

Machine parse_machine_profile(std::string_view text, std::string_view source) {
  const ProfileReader reader(source);
  try {
    return reader.read(toml::parse(text, source));
  } catch (const toml::parse_error& error) {
    reader.fail(error.source(), "", fmt::format("not valid TOML: {}", error.description()));
  }
}

Machine find_machine(const std::string& profile) {
  for (const ShippedProfile& shipped : shipped_profiles()) {
    if (shipped.name == profile) return parse_machine_profile(shipped.text, shipped.name);
  }
  return read_machine_profile(profile);
}

}  // namespace kcs::client
