// What the tests of the store share: an empty database of each kind, and requests.
#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <string>

#include "server/store/store.h"
#include "tests/files/temporary_folder.h"
#include "tests/store/postgres_server.h"

namespace kcs::store {

enum class Kind { kSqlite, kPostgresql };

// The server of this process; it starts when it is asked for first.
test::PostgresServer& postgres();

// Settings for a new empty database, which is gone with the process or the folder.
StoreSettings new_database(Kind kind, const test::TemporaryFolder& folder);

// What an administrator would do: runs a statement on the database itself, beside the store. The first value of its
// result, empty if there is none.
std::string query(const StoreSettings& settings, const std::string& statement);

// Each test runs on every kind of database.
class StoreTest : public ::testing::TestWithParam<Kind> {
 protected:
  StoreTest() : settings_(new_database(GetParam(), folder_)) {}

  test::TemporaryFolder folder_;
  StoreSettings settings_;
};

// Ahead of a suite's name: "Sqlite/Suite.Test/0".
#define KCS_ON_EACH_DATABASE(suite)                                          \
  INSTANTIATE_TEST_SUITE_P(Sqlite, suite, ::testing::Values(Kind::kSqlite)); \
  INSTANTIATE_TEST_SUITE_P(Postgresql, suite, ::testing::Values(Kind::kPostgresql))

// "plans/" and 64 digits, as different as the numbers.
std::string plan_name(std::uint64_t number);

// So many bytes of all values that depend on the number alone; half of them can be compressed.
std::string some_bytes(std::uint64_t number, std::size_t size);

// Machines, places and times of day are as good in one test as in another.
Record accept(Store& store, const std::string& owner, std::uint64_t number, std::string_view bytes = "request");
Record accept_finished(Store& store, const std::string& owner, std::uint64_t number, double cycle_time = 1,
                       const std::string& machine_name = "mill");

// A new run of a plan, by some controller.
RunRecord run_of(std::uint64_t plan, const std::string& machine = "machines/mill");

std::vector<std::string> names(const std::vector<Record>& records);

}  // namespace kcs::store
