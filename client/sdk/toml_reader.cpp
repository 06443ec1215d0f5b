#include "client/sdk/toml_reader.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>
#include <limits>

namespace kcs::client {

toml::table TomlReader::parse(std::string_view text) const {
  try {
    return toml::parse(text, source_);
  } catch (const toml::parse_error& error) {
    fail(error.source(), "", fmt::format("not valid TOML: {}", error.description()));
  }
}

void TomlReader::fail(const toml::source_region& place, std::string_view key, std::string_view problem) const {
  throw SettingsError(fmt::format("{}:{}:{}: {}{}{}", source_, place.begin.line, place.begin.column, key,
                                  key.empty() ? "" : " ", problem));
}

void TomlReader::fail(const toml::node& node, std::string_view key, std::string_view problem) const {
  fail(node.source(), key, problem);
}

void TomlReader::refuse_unknown(const toml::table& table, std::string_view prefix,
                                std::initializer_list<std::string_view> known) const {
  for (const auto& [key, value] : table) {
    if (std::find(known.begin(), known.end(), key.str()) != known.end()) continue;
    std::string names;
    for (const std::string_view name : known) names += (names.empty() ? "" : ", ") + std::string(name);
    fail(key.source(), fmt::format("{}{}", prefix, key.str()), "is not a known key; here can be: " + names);
  }
}

const toml::table& TomlReader::section(const toml::table& root, std::string_view key) const {
  const toml::node* node = root.get(key);
  if (node == nullptr) fail(root, key, fmt::format("is missing; add a section [{}]", key));
  if (!node->is_table()) fail(*node, key, fmt::format("is not a section; write it as [{}]", key));
  return *node->as_table();
}

std::string TomlReader::text(const toml::node& node, std::string_view key) const {
  if (!node.is_string()) fail(node, key, "is not text; put it in double quotes");
  return node.ref<std::string>();
}

bool TomlReader::flag(const toml::node& node, std::string_view key) const {
  if (!node.is_boolean()) fail(node, key, "must be true or false");
  return node.ref<bool>();
}

double TomlReader::number(const toml::node& node, std::string_view key, double low, double high) const {
  const double number = node.is_number() ? node.value_or(0.0) : std::numeric_limits<double>::quiet_NaN();
  if (!(number >= low && number <= high)) fail(node, key, fmt::format("must be a number from {} to {}", low, high));
  return number;
}

std::int64_t TomlReader::whole(const toml::node& node, std::string_view key, std::int64_t low,
                               std::int64_t high) const {
  if (!node.is_integer() || node.ref<std::int64_t>() < low || node.ref<std::int64_t>() > high) {
    fail(node, key, fmt::format("must be a whole number from {} to {}", low, high));
  }
  return node.ref<std::int64_t>();
}

double TomlReader::positive_number(const toml::node& node, std::string_view key) const {
  const double number = node.is_number() ? node.value_or(0.0) : 0.0;
  if (!(number > 0) || !std::isfinite(number)) fail(node, key, "must be a number greater than 0");
  return number;
}

const toml::array& TomlReader::array_per_axis(const toml::node& node, std::string_view key, std::size_t axes) const {
  const std::string remedy = fmt::format("give {} numbers in brackets, one per axis", axes);
  const toml::array* array = node.as_array();
  if (array == nullptr) fail(node, key, "is not an array; " + remedy);
  if (array->size() != axes) {
    fail(node, key, fmt::format("has {} entries for {} axes; {}", array->size(), axes, remedy));
  }
  return *array;
}

std::vector<double> TomlReader::per_axis(const toml::node& node, std::string_view key, std::size_t axes) const {
  constexpr double kLargest = std::numeric_limits<double>::max();
  std::vector<double> numbers;
  for (const toml::node& entry : array_per_axis(node, key, axes)) {
    numbers.push_back(number(entry, fmt::format("{}[{}]", key, numbers.size()), -kLargest, kLargest));
  }
  return numbers;
}

std::vector<double> TomlReader::positive_per_axis(const toml::node& node, std::string_view key,
                                                  std::size_t axes) const {
  std::vector<double> numbers;
  for (const toml::node& entry : array_per_axis(node, key, axes)) {
    numbers.push_back(positive_number(entry, fmt::format("{}[{}]", key, numbers.size())));
  }
  return numbers;
}

std::string read_settings_text(const std::filesystem::path& file, std::string_view remedy) {
  constexpr std::uintmax_t kMostBytes = 1 << 20;  // such a file has some thousand
  std::error_code not_there;
  const bool is_settings =
      std::filesystem::is_regular_file(file, not_there) && std::filesystem::file_size(file, not_there) <= kMostBytes;
  std::ifstream stream(file, std::ios::binary);
  if (!is_settings || !stream.is_open()) {
    throw SettingsError(fmt::format("{}: cannot be read; check its name and permissions{}", file.string(), remedy));
  }
  return {std::istreambuf_iterator<char>(stream), {}};
}

}  // namespace kcs::client
