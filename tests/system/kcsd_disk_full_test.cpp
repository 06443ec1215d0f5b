// The disk of the database of a kcsd is full.
#include <filesystem>
#include <fstream>
#include <random>
#include <string>
#include <vector>

#include "tests/store/small_disk.h"
#include "tests/system/shared_store.h"
#include "tests/system/test_kcsd.h"

namespace kcs::test {
namespace {

// A small program with a megabyte of comments that cannot be compressed much.
std::vector<v1::CreatePlanRequest> large_request(std::uint32_t number) {
  std::mt19937 random(number);
  std::string program = "G1 X" + std::to_string(number) + " F600\n";
  while (program.size() < 1'300'000) {
    program += '(';
    for (int i = 0; i < 200; ++i) program += static_cast<char>('0' + random() % 64);
    program += ")\n";
  }
  return {request(options(3)), gcode(program)};
}

class DiskFull : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!disk_.why_not().empty()) GTEST_SKIP() << "cannot mount a small disk: " << disk_.why_not();
  }

  std::filesystem::path filler() const { return disk_.folder().path() / "filler"; }

  // All that was acknowledged can still be read; once there is room again all goes on.
  void fill_and_recover(TestKcsd& kcsd) {
    std::ofstream(filler()) << std::string(12'000'000, 'x');
    std::vector<v1::Plan> kept;
    grpc::Status full;
    for (std::uint32_t number = 1; number <= 40 && full.ok(); ++number) {
      const auto answer = kcsd.create(large_request(number));
      full = answer.status;
      if (full.ok()) kept.push_back(answer.message);
    }
    ASSERT_EQ(full.error_code(), grpc::StatusCode::RESOURCE_EXHAUSTED) << full.error_message();
    EXPECT_TRUE(tells_when_to_try_again(full));
    EXPECT_NE(full.error_message().find("disk"), std::string::npos) << full.error_message();
    EXPECT_EQ(kcsd.create(accept_only(large_request(41))).status.error_code(), grpc::StatusCode::RESOURCE_EXHAUSTED);
    ASSERT_FALSE(kept.empty());
    for (const v1::Plan& plan : kept) {
      EXPECT_EQ(kcsd.get(plan.name()).message.SerializeAsString(), plan.SerializeAsString());
      EXPECT_TRUE(kcsd.stream(setpoints(plan.name(), 0.01)).status.ok());
    }
    EXPECT_EQ(kcsd.list_all().message.size(), kept.size());
    EXPECT_EQ(kcsd.page("/readyz").status, 200) << "what is there can be read";

    std::filesystem::remove(filler());
    const auto again = kcsd.create(large_request(41));
    EXPECT_TRUE(again.status.ok()) << again.status.error_message();
    EXPECT_TRUE(kcsd.remove(kept.front().name()).ok());
    EXPECT_EQ(kcsd.list_all().message.size(), kept.size());
  }

  SmallDisk disk_;
};

TEST_F(DiskFull, OfSqliteIsSaidAndPasses) {
  TestKcsd kcsd(store_settings("sqlite:" + (disk_.folder().path() / "plans.db").string()));
  fill_and_recover(kcsd);
}

TEST_F(DiskFull, FromTheStartKeepsKcsdFromBeingReadyUntilThereIsRoom) {
  std::ofstream(filler()) << std::string(24'000'000, 'x');
  while (std::ofstream(filler(), std::ios::app) << std::string(4096, 'x') << std::flush) {
  }
  TestKcsd kcsd(store_settings("sqlite:" + (disk_.folder().path() / "plans.db").string()));
  EXPECT_EQ(kcsd.page("/readyz").status, 503);
  std::filesystem::remove(filler());
  EXPECT_TRUE(eventually([&] { return kcsd.page("/readyz").status == 200; }));
  EXPECT_TRUE(kcsd.create(large_request(1)).status.ok());
}

TEST_F(DiskFull, OfPostgresqlIsSaidAndPasses) {
  const auto tables = disk_.folder().path() / "tables";
  std::filesystem::create_directory(tables);
  PostgresqlStore store;
  store.server().give(tables);
  store.server().query("postgres", "create tablespace small location '" + tables.string() + "'");
  store.server().query("postgres", "alter database plans set default_tablespace = small");
  TestKcsd kcsd(store.settings());
  fill_and_recover(kcsd);
}

}  // namespace
}  // namespace kcs::test
