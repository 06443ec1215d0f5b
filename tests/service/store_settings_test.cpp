// The table [store] of the configuration file.
#include "server/service/store_settings.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "server/service/config.h"

namespace kcs::service {
namespace {

namespace fs = std::filesystem;

class StoreSettingsFile : public ::testing::Test {
 protected:
  ~StoreSettingsFile() override { fs::remove(file_); }

  store::StoreSettings load(const std::string& lines) const {
    std::ofstream(file_) << "[store]\n" << lines;
    return load_config(file_.string()).server.store;
  }

  // What it says against the lines.
  std::string refusal(const std::string& lines) const {
    try {
      load(lines);
      return {};
    } catch (const std::runtime_error& refused) {
      return refused.what();
    }
  }

  const fs::path file_ = fs::temp_directory_path() / ("store_settings_test." + std::to_string(::getpid()));
};

TEST_F(StoreSettingsFile, SaysAllThereIs) {
  const store::StoreSettings settings = load(R"(
database = "postgresql:host=db dbname=kcs"
password_file = "/run/secrets/db"
connections = 3
timeout_s = 2.5
lease_s = 60
keep_days = 7
keep_bytes = 1_000_000
)");
  EXPECT_EQ(settings.database, "postgresql:host=db dbname=kcs");
  EXPECT_EQ(settings.password_file, "/run/secrets/db");
  EXPECT_EQ(settings.connections, 3);
  EXPECT_EQ(settings.timeout, std::chrono::milliseconds(2500));
  EXPECT_EQ(settings.lease, std::chrono::minutes(1));
  EXPECT_EQ(settings.keep, std::chrono::hours(24 * 7));
  EXPECT_EQ(settings.keep_bytes, 1'000'000);
}

TEST_F(StoreSettingsFile, IsRefusedWithItsLineAndWhatIsAllowed) {
  EXPECT_NE(refusal("\ndatabase = \"mysql:db\"").find(":3: \"mysql:db\" is no database: use"), std::string::npos);
  EXPECT_NE(refusal("database = \"postgresql:host=a b\"").find(":2: "), std::string::npos);
  EXPECT_NE(refusal("keep_days = 0").find("from 1 to 36500"), std::string::npos);
  EXPECT_NE(refusal("keep_bytes = 0"), "");
  EXPECT_NE(refusal("connections = 0"), "");
  EXPECT_NE(refusal("timeout_s = 0.5"), "");
  EXPECT_NE(refusal("password = \"secret\"").find("unknown key"), std::string::npos);
}

TEST_F(StoreSettingsFile, LeavesWhatItDoesNotSayAtTheDefaults) {
  const store::StoreSettings settings = load("");
  EXPECT_EQ(settings.database, "sqlite");
  EXPECT_EQ(settings.keep, std::chrono::hours(24 * 30));
}

}  // namespace
}  // namespace kcs::service
