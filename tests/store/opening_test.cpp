// How a store opens, and what it says if it cannot.
#include <gmock/gmock.h>
#include <sqlite3.h>
#include <stdlib.h>
#include <sys/stat.h>

#include <fstream>
#include <memory>
#include <thread>

#include "server/store/sqlite.h"
#include "tests/store/store_test.h"

namespace kcs::store {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::HasSubstr;

// What the store says when it is opened, or empty if it opens. `Failure`: just this exception.
template <typename Failure>
std::string failure(const StoreSettings& settings) {
  try {
    Store store(settings);
    return {};
  } catch (const Failure& thrown) {
    EXPECT_TRUE(typeid(thrown) == typeid(Failure)) << thrown.what();
    return thrown.what();
  }
}

using Opening = StoreTest;
KCS_ON_EACH_DATABASE(Opening);

TEST_P(Opening, ManyMayOpenAnEmptyDatabaseAtTheSameMoment) {
  std::vector<std::thread> servers;
  for (std::uint64_t number = 1; number <= 8; ++number) {
    servers.emplace_back([this, number] {
      Store store(settings_);
      accept_finished(store, "ada", number);
    });
  }
  for (std::thread& server : servers) server.join();
  EXPECT_EQ(Store(settings_).list("ada", {}, 100, "").records.size(), 8);
}

TEST_P(Opening, RefusesASchemaThatOnlyNewerServersCanUse) {
  { const Store store(settings_); }
  query(settings_, "update kcs_schema set version = 4, usable_from = 4");
  EXPECT_THAT(failure<StoreError>(settings_), AllOf(HasSubstr("made by a newer kcsd"), HasSubstr("kcsd --schema 3")));
  query(settings_, "update kcs_schema set version = 3, usable_from = 3");
  EXPECT_EQ(failure<StoreError>(settings_), "");
}

TEST_P(Opening, LeavesAlonePartsOfAFailedStart) {
  // A table that is in the way stands for whatever may go wrong in the middle.
  if (GetParam() == Kind::kSqlite) fs::create_directories(folder_.path() / "state");
  query(settings_, "create table request_rows (other integer)");
  EXPECT_THAT(failure<StoreError>(settings_), HasSubstr("already exists"));
  query(settings_, "drop table request_rows");
  EXPECT_EQ(failure<StoreError>(settings_), "");
}

TEST_P(Opening, ADamagedRequestIsNotHandedOut) {
  Store store(settings_);
  accept(store, "ada", 1, some_bytes(1, 100'000));
  const bool is_sqlite = GetParam() == Kind::kSqlite;
  query(settings_, is_sqlite ? "update request_rows set bytes = cast(substr(bytes, 1, 50000) || x'00' || "
                               "substr(bytes, 50002) as blob)"
                             : "update request_rows set bytes = set_byte(bytes, 50000, get_byte(bytes, 50000) # 1)");
  EXPECT_THROW(store.request(plan_name(1)), StoreError);
  EXPECT_TRUE(store.find("ada", plan_name(1)));
}

class OpeningSqlite : public ::testing::Test {
 protected:
  const fs::path file() const { return folder_.path() / "plans.db"; }
  StoreSettings at(const fs::path& path) const { return {.database = "sqlite:" + path.string()}; }

  test::TemporaryFolder folder_;
};

TEST_F(OpeningSqlite, MakesFoldersAndAFileThatOthersCannotRead) {
  const fs::path deep = folder_.path() / "some more/folders = deep/plans.db";
  Store store(at(deep));
  accept_finished(store, "ada", 1);
  for (const char* ending : {"", "-wal", "-shm"}) {
    struct stat found {};
    ASSERT_EQ(stat((deep.string() + ending).c_str(), &found), 0) << ending;
    EXPECT_EQ(found.st_mode & 0777, 0600) << ending;
  }
}

// SQLite itself does not wait there for who writes at that moment, as another server that opens the file does.
TEST_F(OpeningSqlite, WaitsUntilItsJournalCanBeChanged) {
  sqlite3* opened = nullptr;
  ASSERT_EQ(sqlite3_open(file().c_str(), &opened), SQLITE_OK);
  const std::unique_ptr<sqlite3, decltype(&sqlite3_close)> other(opened, &sqlite3_close);
  const auto run = [&](const char* statement) { return sqlite3_exec(opened, statement, nullptr, nullptr, nullptr); };
  ASSERT_EQ(run("pragma auto_vacuum = incremental; create table other (value integer); begin immediate"), SQLITE_OK);
  StoreSettings impatient = at(file());
  impatient.timeout = std::chrono::milliseconds(100);
  EXPECT_THAT(failure<StoreUnavailable>(impatient), HasSubstr("try again later"));
  const std::jthread writes([&] {
    std::this_thread::sleep_for(std::chrono::milliseconds(200));
    run("rollback");
  });
  EXPECT_EQ(failure<StoreUnavailable>(at(file())), "");
}

TEST_F(OpeningSqlite, SaysWhatIsNoDatabase) {
  std::ofstream(file()) << std::string(10'000, 'x');
  const std::string said = failure<StoreError>(at(file()));
  EXPECT_THAT(said, HasSubstr(file().string()));
  EXPECT_THAT(said, HasSubstr("not a database"));
}

TEST_F(OpeningSqlite, SaysWhereItMayNotWrite) {
  const std::string said = failure<StoreError>(at("/dev/null/plans.db"));
  EXPECT_THAT(said, HasSubstr("/dev/null"));
  EXPECT_THAT(said, HasSubstr("Not a directory"));
  EXPECT_THAT(failure<StoreError>(at(folder_.path())), HasSubstr("Is a directory"));
}

TEST_F(OpeningSqlite, ReportsADamagedFile) {
  {
    Store store(at(file()));
    accept(store, "ada", 1, some_bytes(1, 1'000'000));
  }
  std::fstream damaged(file(), std::ios::in | std::ios::out | std::ios::binary);
  damaged.seekp(4096);
  damaged << std::string(static_cast<std::size_t>(fs::file_size(file())) - 4096, 'x');
  damaged.close();
  EXPECT_THROW(
      {
        Store store(at(file()));
        store.request(plan_name(1));
      },
      StoreError);
}

TEST_F(OpeningSqlite, TheDefaultFileIsInTheStateDirectory) {
  const auto with = [](const char* state, const char* xdg, const char* home) {
    const auto set = [](const char* name, const char* value) { value ? setenv(name, value, 1) : unsetenv(name); };
    set("STATE_DIRECTORY", state);
    set("XDG_STATE_HOME", xdg);
    set("HOME", home);
    return default_file();
  };
  const std::string home = getenv("HOME") ? getenv("HOME") : "/";
  EXPECT_EQ(with("/var/lib/kcs", "/x", "/h"), "/var/lib/kcs/plans.db");
  EXPECT_EQ(with("/var/lib/kcs:/var/lib/other", "/x", "/h"), "/var/lib/kcs/plans.db");
  EXPECT_EQ(with(nullptr, "/x", "/h"), "/x/kcs/plans.db");
  EXPECT_EQ(with("", "", "/h"), "/h/.local/state/kcs/plans.db");
  EXPECT_THROW(with(nullptr, nullptr, nullptr), StoreError);
  setenv("HOME", home.c_str(), 1);
}

TEST(OpeningMemory, KeepsUntilItIsClosed) {
  const StoreSettings settings = {.database = "memory"};
  {
    Store store(settings);
    std::vector<std::thread> clients;
    for (std::uint64_t number = 1; number <= 8; ++number) {
      clients.emplace_back([&store, number] {
        accept(store, "ada", number, some_bytes(number, 10'000));
        store.finish(plan_name(number), {.plan = "plan", .cycle_time = 1});
      });
    }
    for (std::thread& client : clients) client.join();
    EXPECT_EQ(store.list("ada", {.state = State::kFinished}, 100, "").records.size(), 8);
    EXPECT_TRUE(store.request(plan_name(3)) == some_bytes(3, 10'000));
    EXPECT_TRUE(store.sweep().empty());
  }
  EXPECT_TRUE(Store(settings).list("ada", {}, 100, "").records.empty());
}

TEST(OpeningPostgresql, SaysWhyItCannotConnect) {
  const test::TemporaryFolder folder;
  StoreSettings settings = new_database(Kind::kPostgresql, folder);
  StoreSettings wrong = settings;
  wrong.password_file = folder.path() / "wrong";
  EXPECT_THAT(failure<StoreUnavailable>(wrong), HasSubstr("cannot read the password"));
  std::ofstream(wrong.password_file) << "not this one\n";
  EXPECT_THAT(failure<StoreUnavailable>(wrong), HasSubstr("password authentication failed"));
  wrong = settings;
  wrong.database += "_missing";
  EXPECT_THAT(failure<StoreUnavailable>(wrong), HasSubstr("does not exist"));
  wrong.database = "postgresql://kcs@localhost:1/kcs";
  EXPECT_THAT(failure<StoreUnavailable>(wrong), HasSubstr("host=localhost port=1 dbname=kcs"));
}

TEST(OpeningPostgresql, SaysThatItMayNotMakeTables) {
  const test::TemporaryFolder folder;
  StoreSettings settings = new_database(Kind::kPostgresql, folder);
  query(settings, "create role guest login password 'guest'");
  settings.database.replace(settings.database.find("user=kcs"), 8, "user=guest");
  settings.password_file = folder.path() / "password";
  std::ofstream(settings.password_file) << "guest\n";
  const std::string said = failure<StoreError>(settings);
  EXPECT_THAT(said, HasSubstr("permission denied"));
  EXPECT_THAT(said, HasSubstr("whether kcsd may make tables"));
}

TEST(OpeningPostgresql, TakesUrisAsWell) {
  const test::TemporaryFolder folder;
  const StoreSettings settings = new_database(Kind::kPostgresql, folder);
  const std::string name = settings.database.substr(settings.database.rfind('=') + 1);
  StoreSettings by_uri = settings;
  by_uri.database = "postgresql://kcs@/" + name + "?host=" + postgres().folder().string();
  Store store(by_uri);
  accept_finished(store, "ada", 1);
  EXPECT_EQ(query(settings, "select count(*) from plans"), "1");
}

TEST(OpeningSettings, RefuseWhatIsNoDatabase) {
  for (const char* database : {"", "sqlite:", "plans.db", "mysql:host=db", "postgresql:nonsense", "postgresql:host=a b",
                               "postgresql://[", "Memory"}) {
    EXPECT_THROW(check_database(database), StoreError) << database;
  }
  for (const char* database : {"memory", "sqlite", "sqlite:plans.db", "postgresql:", "postgresql:host=db dbname=kcs",
                               "postgresql://kcs@db/kcs?sslmode=verify-full"}) {
    EXPECT_NO_THROW(check_database(database)) << database;
  }
}

}  // namespace
}  // namespace kcs::store
