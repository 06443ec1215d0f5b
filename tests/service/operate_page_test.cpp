// deploy/README.md and deploy/kcsd.toml, for those who run kcsd: all settings and figures that there are, and no
// others.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <httplib.h>
#include <toml++/toml.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <sstream>
#include <stdexcept>
#include <string>

#include "server/service/config.h"
#include "server/store/schema_command.h"
#include "server/version/version.h"
#include "tests/service/test_server.h"

namespace kcs::service::test {
namespace {

std::string content(const std::string& file) {
  std::ostringstream text;
  text << std::ifstream(KCS_SOURCE "/deploy/" + file).rdbuf();
  EXPECT_FALSE(text.str().empty()) << file;
  return text.str();
}

std::string as_text(const toml::node& value) {
  std::ostringstream text;
  text << toml::toml_formatter(toml::table{{"value", value}});
  return text.str();
}

// Each setting, TABLE.KEY, with its default.
using Settings = std::map<std::string, std::string>;

Settings example_settings() {
  Settings settings;
  for (const auto& [table, keys] : toml::parse(content("kcsd.toml"))) {
    for (const auto& [key, value] : *keys.as_table()) {
      settings[std::string(table.str()) + "." + std::string(key.str())] = as_text(value);
    }
  }
  return settings;
}

// The rows "| `TABLE.KEY` | `DEFAULT` | …".
Settings page_settings() {
  const std::string page = content("README.md");
  const std::regex row(R"(\n\| `([a-z]+\.[a-z_]+)` \| `([^`]+)` \|)");
  Settings settings;
  for (std::sregex_iterator found(page.begin(), page.end(), row), end; found != end; ++found) {
    const bool added = settings.emplace((*found)[1], as_text(*toml::parse("v = " + found->str(2)).get("v"))).second;
    EXPECT_TRUE(added) << found->str(1) << " is there twice";
  }
  return settings;
}

// What kcsd itself calls the known keys of a table.
std::string known_keys(const std::string& table) {
  const auto file = std::filesystem::temp_directory_path() / ("operate_page_test." + std::to_string(getpid()));
  std::ofstream(file) << "[" << table << "]\nno_such_key = 1\n";
  std::string refusal;
  try {
    load_config(file.string());
  } catch (const std::runtime_error& refused) {
    refusal = refused.what();
  }
  std::filesystem::remove(file);
  constexpr std::string_view kBefore = "known are ";
  const std::size_t list = refusal.find(kBefore);
  EXPECT_NE(list, std::string::npos) << refusal;
  return refusal.substr(list + kBefore.size());
}

TEST(OperatePage, ListsEverySettingOfTheExampleWithItsDefault) { EXPECT_EQ(page_settings(), example_settings()); }

TEST(OperatePage, ExampleNamesEverySettingThatKcsdKnows) {
  for (const auto& [table, keys] : toml::parse(content("kcsd.toml"))) {
    std::string names;
    for (const auto& [key, value] : *keys.as_table()) names += (names.empty() ? "" : ", ") + std::string(key.str());
    EXPECT_EQ(known_keys(std::string(table.str())), names) << table.str();
  }
}

TEST(OperatePage, SettingsOfComposeAndKubernetesAreThoseThatKcsdKnows) {
  for (const std::string file : {"compose/kcsd.toml", "kubernetes/kcsd.toml"}) {
    const Config config = load_config(KCS_SOURCE "/deploy/" + file);
    EXPECT_EQ(config.server.listen, "0.0.0.0:50551") << file;  // the image's ports
    EXPECT_EQ(config.server.observe.http_listen, "0.0.0.0:50552") << file;
  }
}

TEST(OperatePage, NamesEveryFigureThatKcsdShows) {
  ServerOptions options;
  options.observe.http_listen = "127.0.0.1:0";
  TestServer server(options);
  const auto figures = httplib::Client("http://" + server.server().http_address()).Get("/metrics");
  ASSERT_TRUE(figures);
  const auto all = [](const std::string& text, const std::string& pattern) {
    const std::regex expression(pattern);
    std::set<std::string> names;
    for (std::sregex_iterator found(text.begin(), text.end(), expression), end; found != end; ++found) {
      names.insert(found->str(1));
    }
    return names;
  };
  const auto shown = all(figures->body, "# TYPE ([a-z_]+) ");
  EXPECT_GT(shown.size(), 10);
  EXPECT_EQ(all(content("README.md"), R"(\n\| `((?:kcs|process)_[a-z_]+)[`{])"), shown);
}

TEST(OperatePage, SaysWhichTablesThisVersionMakes) {
  EXPECT_NE(content("README.md").find(fmt::format("\n| {} | {} |", version(), store::kSchemaVersion)),
            std::string::npos);
}

}  // namespace
}  // namespace kcs::service::test
