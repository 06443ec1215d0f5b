// The database is gone, slow or locked, and comes back.
#include <arpa/inet.h>
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <sqlite3.h>
#include <sys/socket.h>
#include <unistd.h>

#include <atomic>
#include <barrier>
#include <memory>
#include <thread>

#include "tests/store/store_test.h"

namespace kcs::store {
namespace {

using std::chrono::seconds;
using std::chrono::steady_clock;

constexpr std::chrono::milliseconds kTimeout{2000};

TEST(SqliteOutage, AWriterWaitsForALockAndThenGivesUp) {
  const test::TemporaryFolder folder;
  StoreSettings settings = new_database(Kind::kSqlite, folder);
  settings.timeout = kTimeout;
  Store store(settings);
  accept_finished(store, "ada", 1);
  sqlite3* opened = nullptr;
  ASSERT_EQ(sqlite3_open((folder.path() / "state/plans.db").c_str(), &opened), SQLITE_OK);
  const std::unique_ptr<sqlite3, decltype(&sqlite3_close)> other(opened, &sqlite3_close);
  ASSERT_EQ(sqlite3_exec(opened, "begin immediate", nullptr, nullptr, nullptr), SQLITE_OK);

  const auto begin = steady_clock::now();
  EXPECT_THROW(accept(store, "ada", 2), StoreUnavailable);
  EXPECT_GE(steady_clock::now() - begin, kTimeout * 9 / 10);
  EXPECT_TRUE(store.find("ada", plan_name(1)));
  EXPECT_EQ(store.list("ada", {}, 10, "").records.size(), 1);

  std::thread waiting([&store] { EXPECT_NO_THROW(accept(store, "ada", 3)); });
  std::this_thread::sleep_for(kTimeout / 10);
  ASSERT_EQ(sqlite3_exec(opened, "commit", nullptr, nullptr, nullptr), SQLITE_OK);
  waiting.join();
  EXPECT_NO_THROW(accept(store, "ada", 2));
}

// A server of its own for each test: these stop it.
class PostgresqlOutage : public ::testing::Test {
 protected:
  PostgresqlOutage()
      : settings_{.database = server_.create_database("plans"),
                  .password_file = server_.password_file(),
                  .connections = 4,
                  .timeout = kTimeout} {}

  // As many calls at the same time as there are connections, so that all of them are open.
  void use_all_connections(Store& store) {
    std::barrier together(static_cast<std::ptrdiff_t>(settings_.connections));
    std::vector<std::thread> clients;
    for (std::uint64_t i = 0; i < settings_.connections; ++i) {
      clients.emplace_back([&, i] {
        for (int round = 0; round < 5; ++round) {
          together.arrive_and_wait();
          accept(store, "ada", 1000 + i, some_bytes(i, 100'000));
          store.remove("ada", plan_name(1000 + i));
        }
      });
    }
    for (std::thread& client : clients) client.join();
  }

  // How long the call takes that fails with StoreUnavailable.
  template <typename Call>
  static seconds unavailable_after(const Call& call) {
    const auto begin = steady_clock::now();
    EXPECT_THROW(call(), StoreUnavailable);
    return std::chrono::ceil<seconds>(steady_clock::now() - begin);
  }

  test::PostgresServer server_;
  StoreSettings settings_;
};

TEST_F(PostgresqlOutage, IsReportedAtOnceAndOverWhenTheServerIsBack) {
  Store store(settings_);
  accept_finished(store, "ada", 1);
  use_all_connections(store);
  server_.stop();
  for (int i = 0; i < 6; ++i) {
    EXPECT_THROW(accept(store, "ada", 2), StoreUnavailable);
    EXPECT_THROW(store.find("ada", plan_name(1)), StoreUnavailable);
    EXPECT_THROW(store.list("ada", {}, 10, ""), StoreUnavailable);
    EXPECT_THROW(store.claim(10), StoreUnavailable);
    EXPECT_THROW(store.sweep(), StoreUnavailable);
  }
  EXPECT_THROW(Store{settings_}, StoreUnavailable);
  server_.start();
  EXPECT_TRUE(store.find("ada", plan_name(1)));
  EXPECT_EQ(accept(store, "ada", 2).state, State::kAccepted);
}

TEST_F(PostgresqlOutage, ThatNoCallSawGoesUnnoticed) {
  Store store(settings_);
  for (const bool orderly : {true, false}) {
    accept_finished(store, "ada", 1);
    use_all_connections(store);
    orderly ? server_.stop() : server_.kill();
    server_.start();
    for (int i = 0; i < 6; ++i) EXPECT_TRUE(store.find("ada", plan_name(1)));
    use_all_connections(store);
  }
}

// Begins and ends one run after the other until it is told to stop, as a server does that has to know for each of them
// whether it is there.
void run_again_and_again(Store& store, const std::stop_token& stopping) {
  const auto insist = [](const auto& call) {
    while (true) {
      try {
        return call();
      } catch (const StoreUnavailable&) {
        std::this_thread::sleep_for(std::chrono::milliseconds(5));
      }
    }
  };
  for (int last = 0; !stopping.stop_requested() || last == 0;) {
    std::optional<RunRecord> run;
    try {
      run = store.add_run(run_of(1));
    } catch (const StoreUnavailable&) {
      run = insist([&] { return store.open_run("machines/mill"); });
      if (!run) continue;
    }
    const int number = std::stoi(run->name.substr(run->name.rfind('/') + 1));
    EXPECT_GT(number, last);
    last = number;
    run->state = RunRecordState::kFinished;
    insist([&] {
      store.update_run(*run);
      return true;
    });
  }
}

TEST_F(PostgresqlOutage, InTheMiddleOfRunsLeavesEachOneCertain) {
  Store store(settings_);
  accept_finished(store, "ada", 1);
  {
    const std::jthread machine(
        [&store](const std::stop_token& stopping) { EXPECT_NO_THROW(run_again_and_again(store, stopping)); });
    for (int kills = 0; kills < 4; ++kills) {
      std::this_thread::sleep_for(std::chrono::milliseconds(300));
      server_.kill();
      server_.start();
    }
  }
  EXPECT_FALSE(store.open_run("machines/mill"));
  EXPECT_EQ(server_.query("plans", "select count(*) from runs where state <> 1"), "0");
}

TEST_F(PostgresqlOutage, ThatTakesTheAnswerAwayLeavesTheRunItsBeginners) {
  settings_.timeout = seconds(60);
  Store store(settings_);
  accept_finished(store, "ada", 1);
  // A commit that waits for a replica is done already: if its connection is cut, only the word of it is lost.
  server_.query("postgres", "alter system set synchronous_standby_names = 'nobody'");
  server_.query("postgres", "select pg_reload_conf()");
  std::atomic<bool> cut = false;
  const std::jthread administrator([&] {
    const char* const cut_waiting =
        "select count(pg_terminate_backend(pid)) from pg_stat_activity where wait_event = 'SyncRep'";
    while (server_.query("postgres", cut_waiting) == "0") std::this_thread::sleep_for(std::chrono::milliseconds(10));
    cut = true;
    server_.query("postgres", "alter system reset synchronous_standby_names");
    server_.query("postgres", "select pg_reload_conf()");
  });
  RunRecord run;
  for (int machine = 0; !cut; ++machine) {  // the first ones may be faster than the new settings
    run = store.add_run(run_of(1, "machines/" + std::to_string(machine)));
    EXPECT_EQ(run.name, run.machine + "/runs/1");
  }
  EXPECT_EQ(store.open_run(run.machine), run);
}

TEST_F(PostgresqlOutage, OfAFrozenServerEndsCallsInTime) {
  Store store(settings_);
  accept_finished(store, "ada", 1);
  use_all_connections(store);
  server_.freeze();
  // A call has four times the time-out, then there is one try to connect; libpq waits for 2 s at least.
  EXPECT_LE(unavailable_after([&] { store.find("ada", plan_name(1)); }), seconds(20));
  EXPECT_LE(unavailable_after([&] { Store other(settings_); }), seconds(20));
  server_.thaw();
  EXPECT_TRUE(store.find("ada", plan_name(1)));
}

TEST_F(PostgresqlOutage, LeavesNobodyWaitingForAConnection) {
  settings_.connections = 1;
  Store store(settings_);
  accept_finished(store, "ada", 1);
  server_.freeze();
  std::vector<std::string> said(2);
  std::vector<std::thread> clients;
  for (std::string& text : said) {
    clients.emplace_back([&] {
      try {
        store.find("ada", plan_name(1));
      } catch (const StoreUnavailable& failure) {
        text = failure.what();
      }
    });
  }
  for (std::thread& client : clients) client.join();
  // One has the connection, the other none.
  EXPECT_THAT(said, ::testing::Contains(::testing::HasSubstr("all connections")));
  EXPECT_THAT(said, ::testing::Contains(::testing::HasSubstr("closed the connection")));
  server_.thaw();
  EXPECT_TRUE(store.find("ada", plan_name(1)));
}

TEST_F(PostgresqlOutage, ByALockEndsCallsInTime) {
  Store store(settings_);
  accept_finished(store, "ada", 1);
  std::thread administrator([this] {
    EXPECT_THROW(server_.query("plans", "begin; lock table plans; select pg_sleep(600)"), std::runtime_error);
  });
  const auto sleepers = [this](const std::string& what) {
    return server_.query("postgres",
                         "select " + what + " from pg_stat_activity where wait_event = 'PgSleep' and state = 'active'");
  };
  while (sleepers("count(*)") == "0") std::this_thread::sleep_for(std::chrono::milliseconds(20));
  EXPECT_LE(unavailable_after([&] { accept(store, "ada", 2); }), seconds(20));
  sleepers("pg_terminate_backend(pid)");
  administrator.join();
  EXPECT_NO_THROW(accept(store, "ada", 2));
}

TEST(PostgresqlHost, ThatNeverAnswersIsGivenUp) {
  const int listener = socket(AF_INET, SOCK_STREAM, 0);
  sockaddr_in address{.sin_family = AF_INET, .sin_port = 0, .sin_addr = {htonl(INADDR_LOOPBACK)}};
  socklen_t size = sizeof address;
  ASSERT_EQ(bind(listener, reinterpret_cast<sockaddr*>(&address), size), 0);
  ASSERT_EQ(listen(listener, 10), 0);
  ASSERT_EQ(getsockname(listener, reinterpret_cast<sockaddr*>(&address), &size), 0);
  const StoreSettings settings = {.database = fmt::format("postgresql://kcs@127.0.0.1:{}/kcs", ntohs(address.sin_port)),
                                  .timeout = kTimeout};
  const auto begin = steady_clock::now();
  EXPECT_THROW(Store{settings}, StoreUnavailable);
  EXPECT_LE(steady_clock::now() - begin, seconds(20));
  close(listener);
}

}  // namespace
}  // namespace kcs::store
