// A database that an older kcsd made, or is to use again.
#include <gmock/gmock.h>

#include <sstream>
#include <thread>

#include "server/store/schema_command.h"
#include "tests/rpc/eventually.h"
#include "tests/store/store_test.h"

namespace kcs::store {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

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

  // What kcsd prints.
  std::string change_to(int version) const {
    // PostgreSQL notices some time later that a connection was closed.
    const char* const open =
        "select count(*) from pg_stat_activity where application_name = 'kcsd' and datname = "
        "current_database()";
    if (GetParam() == Kind::kPostgresql) {
      EXPECT_TRUE(test::eventually([&] { return query(settings_, open) == "0"; }));
    }
    return change_beside_others(version);
  }

  std::string change_beside_others(int version) const {
    std::ostringstream out;
    change_schema(settings_, version, out);
    return out.str();
  }

  std::string refusal_of(int version) const {
    try {
      return "no refusal, but " + change_beside_others(version);
    } catch (const StoreError& refused) {
      return refused.what();
    }
  }

  // The tables with their columns, and the indexes.
  std::string structure() const {
    if (GetParam() == Kind::kSqlite) {
      return query(settings_,
                   "select group_concat(line, ' ') from (select m.name || '.' || p.name || ':' || p.type || p.pk || "
                   "p.\"notnull\" || coalesce(p.dflt_value, '') line from sqlite_master m join "
                   "pragma_table_info(m.name) p where m.type = 'table' union select name from sqlite_master where type "
                   "= 'index' order by 1)");
    }
    return query(settings_,
                 "select string_agg(line, ' ' order by line) from (select table_name || '.' || column_name || ':' || "
                 "data_type || is_nullable || coalesce(column_default, '') line from information_schema.columns where "
                 "table_schema = 'public' union select indexdef from pg_indexes where schemaname = 'public') lines");
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
  EXPECT_EQ(query(settings_, "select version from kcs_schema"), "3");
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

TEST_P(Upgrade, GoesBackAndForwardAgainAndKeepsThePlans) {
  {
    Store store(settings_);
    accept_finished(store, "ada", 3);
    EXPECT_EQ(store.add_run(run_of(1)).name, "machines/mill/runs/1");
  }
  EXPECT_THAT(change_to(1), AllOf(HasSubstr("were of version 3 and are of version 1"), HasSubstr("lost: all runs")));
  EXPECT_EQ(query(settings_, "select version from kcs_schema"), "1");
  Store store(settings_);
  EXPECT_EQ(query(settings_, "select version from kcs_schema"), "3");
  EXPECT_EQ(store.list("ada", {}, 10, "").records.size(), 3);
  EXPECT_EQ(store.find("ada", plan_name(1))->outcome, "plan");
  EXPECT_EQ(store.find("ada", plan_name(3))->outcome, "plan");
  EXPECT_EQ(store.request(plan_name(2)), "request");
  EXPECT_EQ(store.open_run("machines/mill"), std::nullopt);
  EXPECT_EQ(store.remove("ada", plan_name(1)), Removal::kGone) << "the run does not own it any more";
}

TEST_P(Upgrade, GoesBackToJustTheTablesThatTheOlderOneMade) {
  std::vector<std::string> on_the_way = {structure()};
  for (int version = 2; version <= kSchemaVersion; ++version) {
    change_to(version);
    on_the_way.push_back(structure());
    EXPECT_NE(on_the_way.end()[-1], on_the_way.end()[-2]) << version;
  }
  for (int version = kSchemaVersion; version >= 1; --version) {
    change_to(version);
    EXPECT_EQ(structure(), on_the_way[version - 1]) << version;
  }
}

TEST_P(Upgrade, BackForgetsPlansThatOnlyARunKept) {
  {
    Store store(settings_);
    store.add_run(run_of(1));
    EXPECT_EQ(store.remove("ada", plan_name(1)), Removal::kOthersKeepIt);
  }
  change_to(1);
  for (const char* table : {"plans", "owners", "request_rows"}) {
    EXPECT_EQ(query(settings_, std::string("select min(name) || count(*) from ") + table), plan_name(2) + "1") << table;
  }
}

TEST_P(Upgrade, DoesNotGoBackUnderAServerThatRuns) {
  {
    Store store(settings_);
    EXPECT_THAT(refusal_of(2), HasSubstr("stop every kcsd"));
    EXPECT_EQ(store.add_run(run_of(1)).name, "machines/mill/runs/1");
    EXPECT_THAT(change_beside_others(3), HasSubstr("were of version 3 and are of version 3"))
        << "which takes nothing away";
    EXPECT_TRUE(store.find("ada", plan_name(1)));
  }
  EXPECT_THAT(change_to(2), HasSubstr("are of version 2"));
}

TEST_P(Upgrade, RefusesVersionsThatItDoesNotKnow) {
  EXPECT_THAT(refusal_of(0), HasSubstr("this kcsd knows 1 to 3"));
  EXPECT_THAT(refusal_of(4), HasSubstr("this kcsd knows 1 to 3"));
  change_to(3);
  query(settings_, "update kcs_schema set version = 4");
  EXPECT_THAT(refusal_of(2), HasSubstr("made by a newer kcsd"));
  query(settings_, "drop table kcs_schema");
  EXPECT_THAT(refusal_of(2), HasSubstr("has no tables of kcsd"));
}

// What a newer kcsd will do to the tables while this one still runs: it adds.
TEST_P(Upgrade, LeavesTheOlderServerWorkingBesideTheNewerOne) {
  Store before(settings_);
  query(settings_, "alter table plans add column colour text; alter table runs add column load integer default 7");
  query(settings_, "create table tools (name text primary key); update kcs_schema set version = 4");
  Store after(settings_);
  EXPECT_EQ(query(settings_, "select version from kcs_schema"), "4");
  accept(before, "ada", 3);
  after.finish(plan_name(3), {.plan = "made", .cycle_time = 1});
  EXPECT_EQ(before.find("ada", plan_name(3))->outcome, "made");
  EXPECT_EQ(before.list("ada", {}, 10, "").records.size(), 3);
  RunRecord run = after.add_run(run_of(3));
  run.state = RunRecordState::kFinished;
  before.update_run(run);
  EXPECT_EQ(after.find_run(run.name), run);
  EXPECT_TRUE(before.sweep().empty());
}

}  // namespace
}  // namespace kcs::store
