#include "server/service/settings_file.h"

#include <spdlog/fmt/ranges.h>

#include <cmath>
#include <stdexcept>
#include <utility>
#include <vector>

namespace kcs::service {
namespace {

[[noreturn]] void refuse(const toml::source_region& where, const std::string& what) {
  throw std::runtime_error(fmt::format("{}:{}: {}", where.path ? *where.path : "", where.begin.line, what));
}

void read_table(const toml::table& table, const std::string& name, const Keys& keys) {
  for (const auto& [key, value] : table) {
    const auto known = keys.find(key.str());
    if (known == keys.end()) {
      std::vector<std::string> names;
      for (const auto& entry : keys) names.push_back(entry.first);
      refuse(key.source(), fmt::format("unknown key \"{}\" {}; known are {}", key.str(), name, fmt::join(names, ", ")));
    }
    known->second(value);
  }
}

void read_root(const std::string& file, const Keys& tables, const std::function<toml::table()>& parse) {
  toml::table root;
  try {
    root = parse();
  } catch (const toml::parse_error& error) {
    if (error.source().begin.line == 0) throw std::runtime_error(file + ": " + std::string(error.description()));
    refuse(error.source(), std::string(error.description()));
  }
  read_table(root, "at the top level", tables);
}

std::string string_in(const toml::node& node) {
  const auto value = node.value_exact<std::string>();
  if (!value) refuse_value(node, "must be a string");
  return *value;
}

}  // namespace

void refuse_value(const toml::node& node, const std::string& what) { refuse(node.source(), what); }

void read_tables(const std::string& file, const Keys& tables) {
  read_root(file, tables, [&file] { return toml::parse_file(file); });
}

void read_tables(const std::string& text, const std::string& file, const Keys& tables) {
  read_root(file, tables, [&] { return toml::parse(text, file); });
}

TakeValue table_of(const std::string& name, Keys keys) {
  return [name, keys = std::move(keys)](const toml::node& node) {
    if (!node.is_table()) refuse_value(node, name + " must be a table");
    read_table(*node.as_table(), "in [" + name + "]", keys);
  };
}

TakeValue tables_of(const std::string& name, std::function<Keys()> begin) {
  return [name, begin = std::move(begin)](const toml::node& node) {
    if (!node.is_array_of_tables()) refuse_value(node, name + " must be tables, each headed [[" + name + "]]");
    for (const toml::node& table : *node.as_array()) read_table(*table.as_table(), "in [[" + name + "]]", begin());
  };
}

TakeValue text(std::string& target) {
  return [&target](const toml::node& node) { target = string_in(node); };
}

TakeValue flag(bool& target) {
  return [&target](const toml::node& node) {
    const auto value = node.value_exact<bool>();
    if (!value) refuse_value(node, "must be true or false");
    target = *value;
  };
}

TakeValue seconds(std::chrono::milliseconds& target, double low, double high) {
  return [&target, low, high](const toml::node& node) {
    const auto value = node.value<double>();
    if (!value || !(*value >= low && *value <= high)) {
      refuse_value(node, fmt::format("must be a number of seconds from {} to {}", low, high));
    }
    target = std::chrono::milliseconds(std::llround(*value * 1000));
  };
}

TakeValue parsed(std::function<void(const std::string&)> parse) {
  return [parse = std::move(parse)](const toml::node& node) {
    const std::string value = string_in(node);
    try {
      parse(value);
    } catch (const std::runtime_error& failure) {
      refuse_value(node, failure.what());
    }
  };
}

}  // namespace kcs::service
