// A database that an older kcsd made.
#include <thread>

#include "tests/store/store_test.h"

namespace kcs::store {
namespace {

// As the first kcsd with a store left it: a plan that is finished, one that waits. What the kinds of databases say
// differently is given: the type of bytes, and how they are written, with "$" for their hexadecimal digits.
std::string version_1(const std::string& type, const std::string& literal) {
  const auto bytes = [&literal](const std::string& digits) {
    std::string text = literal;
    return text.replace(text.find('$'), 1, digits);
  };
  const std::string request = bytes("28b52ffd240739000072657175657374ae710062");  // "request", compressed
  std::string script = R"(
      create table kcs_schema (version integer not null);
      create table plans (name text primary key, machine_name text not null, state smallint not null,
                          cycle_time double precision, outcome )" +
                       type + R"( not null, request_bytes bigint not null,
                          stored_bytes bigint not null, accept_time bigint not null, use_time bigint not null,
                          planner text not null, lease_end bigint not null);
      create index plans_by_use on plans (use_time);
      create index plans_to_plan on plans (accept_time) where state = 0;
      create table owners (owner text not null, name text not null, create_time bigint not null,
                           primary key (owner, name));
      create index owners_by_plan on owners (name);
      create index owners_by_time on owners (owner, create_time, name);
      create table request_rows (name text not null, position integer not null, bytes )" +
                       type + R"( not null,
                                 primary key (name, position));
      insert into kcs_schema (version) values (1);)";
  const std::string time = "1800000000000000";
  const std::string finished = "'" + plan_name(1) + "'";
  const std::string waiting = "'" + plan_name(2) + "'";
  script += "insert into plans values (" + finished + ", 'mill', 1, 2.5, " + bytes("706c616e") + ", 7, 20, " + time +
            ", " + time + ", '', 0);";
  script += "insert into plans values (" + waiting + ", 'mill', 0, null, " + bytes("") + ", 7, 16, " + time + ", " +
            time + ", '', 0);";
  for (const std::string& name : {finished, waiting}) {
    script += "insert into owners values ('ada', " + name + ", " + time + ");";
    script += "insert into request_rows values (" + name + ", 0, " + request + ");";
  }
  return script;
}

class Upgrade : public StoreTest {
 protected:
  Upgrade() {
    if (GetParam() == Kind::kSqlite) std::filesystem::create_directories(folder_.path() / "state");
    query(settings_,
          GetParam() == Kind::kSqlite ? version_1("blob", "x'$'") : version_1("bytea", "decode('$', 'hex')"));
  }
};
KCS_ON_EACH_DATABASE(Upgrade);

TEST_P(Upgrade, KeepsThePlansAndTakesRuns) {
  Store store(settings_);
  const std::optional<Record> finished = store.find("ada", plan_name(1));
  ASSERT_TRUE(finished);
  EXPECT_EQ(finished->state, State::kFinished);
  EXPECT_EQ(finished->outcome, "plan");
  EXPECT_EQ(finished->create_time, Time(std::chrono::seconds(1'800'000'000)));
  EXPECT_EQ(store.request(plan_name(1)), "request");
  EXPECT_EQ(store.list("ada", {.cycle_time_at_least = 2.5}, 10, "").records.size(), 1);
  EXPECT_EQ(store.claim(10), std::vector{plan_name(2)});
  EXPECT_EQ(store.request(plan_name(2)), "request");
  EXPECT_EQ(store.add_run(run_of(1)).name, "machines/mill/runs/1");
  EXPECT_EQ(query(settings_, "select version from kcs_schema"), "2");
}

TEST_P(Upgrade, ByManyServersAtTheSameMomentIsDoneOnce) {
  std::vector<std::thread> servers;
  for (int i = 0; i < 6; ++i) {
    servers.emplace_back([this] { EXPECT_TRUE(Store(settings_).find("ada", plan_name(1))); });
  }
  for (std::thread& server : servers) server.join();
  EXPECT_EQ(query(settings_, "select count(*) from kcs_schema"), "1");
  EXPECT_EQ(Store(settings_).add_run(run_of(1)).name, "machines/mill/runs/1");
}

}  // namespace
}  // namespace kcs::store
