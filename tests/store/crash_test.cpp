// Processes that are killed while they write, databases that are killed while they are written to: nothing that was
// acknowledged is lost, nothing half-written is seen.
//
// KCS_STORE_KILLS=N kills so many times instead of a few.
#include <signal.h>
#include <stdlib.h>

#include <map>
#include <random>
#include <sstream>
#include <thread>

#include "tests/store/store_test.h"
#include "tests/store/writer.h"
#include "tests/system/child_process.h"

namespace kcs::store {
namespace {

constexpr std::uint64_t kEndless = 1'000'000;

int kills() {
  const char* given = getenv("KCS_STORE_KILLS");
  return given ? atoi(given) : 8;
}

// A process that writes, and what the store has acknowledged to it.
class Writer {
 public:
  Writer(const StoreSettings& settings, const std::string& owner, std::uint64_t first, std::uint64_t count = kEndless)
      : owner_(owner),
        process_({STORE_WRITER, settings.database, settings.password_file, owner, std::to_string(first),
                  std::to_string(count)}) {}

  // Reads one word of acknowledgement; false if the process has ended.
  bool read() {
    const std::string line = process_.read_line();
    std::istringstream words(line);
    std::string what;
    std::uint64_t number = 0;
    if (!(words >> what >> number)) return false;
    acknowledged_[number] = what;
    last_ = number;
    return true;
  }

  void follow(std::chrono::milliseconds time) {
    const auto end = std::chrono::steady_clock::now() + time;
    while (std::chrono::steady_clock::now() < end && read()) {
    }
  }

  void follow_to_the_end() {
    while (read()) {
    }
  }

  void kill() {
    process_.send_signal(SIGKILL);
    follow_to_the_end();
    process_.wait();
  }

  void expect_end() { EXPECT_EQ(process_.wait(), 0) << process_.errors(); }

  std::uint64_t last() const { return last_; }

  // All that was acknowledged is there, and all of it that is there is whole. What it was about when it was killed may
  // be done or not.
  void check(Store& store) const {
    for (const auto& [number, what] : acknowledged_) {
      const std::optional<Record> found = store.find(owner_, plan_name(number));
      if (what == "removed") {
        EXPECT_FALSE(found) << number;
        continue;
      }
      if (!found && number == last_ && is_removed(number)) continue;
      ASSERT_TRUE(found) << what << " " << number << " is lost";
      EXPECT_TRUE(what == "accepted" || found->state == State::kFinished) << number;
    }
    for (std::uint64_t number = last_ > 20 ? last_ - 20 : 0; number <= last_ + 1; ++number) {
      const std::optional<Record> found = store.find(owner_, plan_name(number));
      if (!found) continue;
      EXPECT_TRUE(store.request(plan_name(number)) == written_bytes(number)) << number << " is damaged";
      EXPECT_EQ(found->outcome, found->state == State::kFinished ? written_plan(number) : "");
    }
  }

 private:
  std::string owner_;
  std::map<std::uint64_t, std::string> acknowledged_;  // the last word about each number
  std::uint64_t last_ = 0;
  test::ChildProcess process_;
};

using Crash = StoreTest;
KCS_ON_EACH_DATABASE(Crash);

TEST_P(Crash, OfAWriterLosesNothingAcknowledged) {
  std::mt19937 random(20'261);
  std::uniform_int_distribution milliseconds(0, 300);
  std::uint64_t first = 0;
  for (int round = 0; round < kills(); ++round) {
    Writer writer(settings_, "ada", first);
    // Every other one is killed while it writes, the rest while they start, perhaps.
    const std::chrono::milliseconds time(milliseconds(random));
    if (round % 2 == 0 && writer.read()) {
      writer.follow(time);
    } else {
      std::this_thread::sleep_for(time);
    }
    writer.kill();
    Store store(settings_);
    writer.check(store);
    first = std::max(first, writer.last() + 1);
  }
  EXPECT_GE(first, kills() / 2);
  const std::string orphans = "select count(*) from request_rows where name not in (select name from plans)";
  EXPECT_EQ(query(settings_, orphans), "0");
}

TEST_P(Crash, OfOneWriterDoesNotDisturbTheOther) {
  Writer first(settings_, "ada", 0, 60);
  Writer second(settings_, "bob", 0);
  EXPECT_TRUE(second.read());
  second.follow(std::chrono::milliseconds(300));
  second.kill();
  first.follow_to_the_end();
  first.expect_end();
  Store store(settings_);
  first.check(store);
  second.check(store);
}

TEST_P(Crash, TwoProcessesWriteTheSamePlansTogether) {
  Writer first(settings_, "ada", 0, 60);
  Writer second(settings_, "bob", 0, 60);
  first.follow_to_the_end();
  second.follow_to_the_end();
  first.expect_end();
  second.expect_end();
  Store store(settings_);
  first.check(store);
  second.check(store);
  EXPECT_EQ(store.list("ada", {}, 1000, "").records.size(), 48);
  EXPECT_EQ(store.list("bob", {}, 1000, "").records.size(), 48);
  EXPECT_EQ(query(settings_, "select count(*) from plans"), "48");
}

TEST(PostgresqlCrash, OfTheDatabaseLosesNothingAcknowledged) {
  test::PostgresServer server;
  const StoreSettings settings = {.database = server.create_database("plans"), .password_file = server.password_file()};
  Writer writer(settings, "ada", 0);
  for (int round = 0; round < std::max(2, kills() / 4); ++round) {
    EXPECT_TRUE(writer.read());  // it goes on
    writer.follow(std::chrono::milliseconds(500));
    server.kill();
    server.start();
  }
  // What it said before may still be in the pipe; all this can only come from the server that was started last.
  for (const std::uint64_t end = writer.last() + 20; writer.last() < end;) ASSERT_TRUE(writer.read());
  writer.kill();
  Store store(settings);
  writer.check(store);
}

}  // namespace
}  // namespace kcs::store
