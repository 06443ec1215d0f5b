// The disk of the database is full, for real: a small one is mounted for the test, which only root may do.
#include <filesystem>
#include <fstream>

#include "tests/store/small_disk.h"
#include "tests/store/store_test.h"

namespace kcs::store {
namespace {

class DiskFull : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!disk_.why_not().empty()) GTEST_SKIP() << "cannot mount a small disk: " << disk_.why_not();
  }

  std::filesystem::path filler() const { return disk_.folder().path() / "filler"; }

  // Fills the disk with plans: all that was accepted stays readable, and once there is room again all goes on.
  void fill_and_recover(Store& store) {
    std::ofstream(filler()) << std::string(12'000'000, 'x');
    std::uint64_t kept = 0;
    bool full = false;
    for (std::uint64_t number = 1; number <= 40 && !full; ++number) {
      try {
        accept(store, "ada", number, some_bytes(number, 1'000'000));
        kept = number;
      } catch (const StoreFull&) {
        full = true;
      }
    }
    ASSERT_TRUE(full);
    ASSERT_GE(kept, 2);
    EXPECT_THROW(accept(store, "ada", 100, some_bytes(100, 3'000'000)), StoreFull);
    EXPECT_FALSE(store.find("ada", plan_name(100)));
    for (std::uint64_t number = 1; number <= kept; ++number) {
      EXPECT_TRUE(store.request(plan_name(number)) == some_bytes(number, 1'000'000)) << number;
    }
    EXPECT_EQ(store.list("ada", {}, 100, "").records.size(), kept);

    std::filesystem::remove(filler());
    EXPECT_NO_THROW(accept(store, "ada", 100, some_bytes(100, 3'000'000)));
    EXPECT_TRUE(store.request(plan_name(100)) == some_bytes(100, 3'000'000));
    EXPECT_EQ(store.remove("ada", plan_name(1)), Removal::kGone);
    EXPECT_EQ(store.list("ada", {}, 100, "").records.size(), kept);
  }

  test::SmallDisk disk_;
};

TEST_F(DiskFull, OfSqliteIsSaidAndPasses) {
  Store store(new_database(Kind::kSqlite, disk_.folder()));
  fill_and_recover(store);
}

TEST_F(DiskFull, OfSqliteIsSaidAtTheStart) {
  std::ofstream(filler()) << std::string(30'000'000, 'x');
  const StoreSettings settings = new_database(Kind::kSqlite, disk_.folder());
  EXPECT_THROW(Store{settings}, StoreFull);
  std::filesystem::remove(filler());
  EXPECT_NO_THROW(Store{settings});
}

TEST_F(DiskFull, OfPostgresqlIsSaidAndPasses) {
  const auto tables = disk_.folder().path() / "tables";
  std::filesystem::create_directory(tables);
  test::PostgresServer server;
  server.give(tables);
  const StoreSettings settings = {.database = server.create_database("plans"), .password_file = server.password_file()};
  server.query("postgres", "create tablespace small location '" + tables.string() + "'");
  server.query("postgres", "alter database plans set default_tablespace = small");
  Store store(settings);
  fill_and_recover(store);
}

}  // namespace
}  // namespace kcs::store
