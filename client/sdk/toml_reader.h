// Takes a TOML file apart and says where something is wrong with it. Used inside the library, and by programs that have
// settings of their own.
#pragma once

#include <toml++/toml.h>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

#include "client/sdk/settings_error.h"

namespace kcs::client {

// All of its functions throw SettingsError. `key` is how the error calls a value: "limits.rapid_mm_s".
class TomlReader {
 public:
  // source: what the file is called in errors.
  explicit TomlReader(std::string source) : source_(std::move(source)) {}

  toml::table parse(std::string_view text) const;

  [[noreturn]] void fail(const toml::node& node, std::string_view key, std::string_view problem) const;
  // A key that is not known is an error, never passed over.
  void refuse_unknown(const toml::table& table, std::string_view prefix,
                      std::initializer_list<std::string_view> known) const;

  const toml::table& section(const toml::table& root, std::string_view key) const;
  std::string text(const toml::node& node, std::string_view key) const;
  bool flag(const toml::node& node, std::string_view key) const;
  double number(const toml::node& node, std::string_view key, double low, double high) const;
  std::int64_t whole(const toml::node& node, std::string_view key, std::int64_t low, std::int64_t high) const;
  double positive_number(const toml::node& node, std::string_view key) const;
  // One number per axis, finite.
  std::vector<double> per_axis(const toml::node& node, std::string_view key, std::size_t axes) const;
  // The same, all greater than 0.
  std::vector<double> positive_per_axis(const toml::node& node, std::string_view key, std::size_t axes) const;

 private:
  [[noreturn]] void fail(const toml::source_region& place, std::string_view key, std::string_view problem) const;
  const toml::array& array_per_axis(const toml::node& node, std::string_view key, std::size_t axes) const;

  std::string source_;
};

// The text of a file of settings. Throws SettingsError if it cannot be read or is too long to be one; `remedy` says
// what else one can do.
std::string read_settings_text(const std::filesystem::path& file, std::string_view remedy);

}  // namespace kcs::client
