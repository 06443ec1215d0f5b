// Reads the tables of a configuration file, key by key: what is unknown or out of range is refused with its place.
#pragma once

#include <spdlog/fmt/fmt.h>
#include <toml++/toml.h>

#include <chrono>
#include <cstdint>
#include <functional>
#include <map>
#include <string>

namespace kcs::service {

// What to do with a value.
using TakeValue = std::function<void(const toml::node&)>;
// What to do with the value of each key of a table.
using Keys = std::map<std::string, TakeValue, std::less<>>;

// Throws std::runtime_error: "FILE:LINE: what".
[[noreturn]] void refuse_value(const toml::node& node, const std::string& what);

// Reads a whole file: each of its tables. Throws std::runtime_error that starts with "FILE:LINE:".
void read_tables(const std::string& file, const Keys& tables);
// The same for the text of a file that was read already.
void read_tables(const std::string& text, const std::string& file, const Keys& tables);

// The value of a table; the name is its key, without brackets.
TakeValue table_of(const std::string& name, Keys keys);
// The value of an array of tables, [[name]]: `begin` is called for each of them, and its keys are read then.
TakeValue tables_of(const std::string& name, std::function<Keys()> begin);

// A string.
TakeValue text(std::string& target);
// True or false.
TakeValue flag(bool& target);
// A number of seconds.
TakeValue seconds(std::chrono::milliseconds& target, double low, double high);
// A string that `parse` understands; it throws std::runtime_error if not.
TakeValue parsed(std::function<void(const std::string&)> parse);

// A whole number from `low` to `high`.
template <typename Integer>
TakeValue whole(Integer& target, std::int64_t low, std::int64_t high) {
  return [&target, low, high](const toml::node& node) {
    const auto value = node.value_exact<std::int64_t>();
    if (!value || *value < low || *value > high) {
      refuse_value(node, fmt::format("must be a whole number from {} to {}", low, high));
    }
    target = static_cast<Integer>(*value);
  };
}

}  // namespace kcs::service
