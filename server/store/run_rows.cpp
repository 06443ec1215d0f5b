#include "server/store/run_rows.h"

#include <fmt/format.h>

namespace kcs::store {
namespace {

// The one run that meets a condition on the parameter :value.
std::optional<RunRecord> select(soci::session& session, const char* condition, const std::string& value) {
  RunRecord run;
  int state = 0;
  int held = 0;
  long long create_time = 0;
  session << fmt::format(
      "select name, machine, plan, controller, state, held, feed_override, plan_time, reason, create_time from runs "
      "where {}",
      condition),
      soci::use(value, "value"), soci::into(run.name), soci::into(run.machine), soci::into(run.plan),
      soci::into(run.controller), soci::into(state), soci::into(held), soci::into(run.feed_override),
      soci::into(run.plan_time), soci::into(run.reason), soci::into(create_time);
  if (!session.got_data()) return std::nullopt;
  run.state = static_cast<RunRecordState>(state);
  run.held = held != 0;
  run.create_time = Time(std::chrono::microseconds(create_time));
  return run;
}

}  // namespace

std::optional<RunRecord> select_run(soci::session& session, const std::string& name) {
  return select(session, "name = :value", name);
}

std::optional<RunRecord> select_open_run(soci::session& session, const std::string& machine) {
  return select(session, "machine = :value and state = 0", machine);
}

long long take_run_number(soci::session& session, const std::string& machine) {
  session << "insert into machines (machine, runs) values (:machine, 1) "
             "on conflict (machine) do update set runs = machines.runs + 1",
      soci::use(machine, "machine");
  long long number = 0;
  session << "select runs from machines where machine = :machine", soci::use(machine, "machine"), soci::into(number);
  return number;
}

void insert_run(soci::session& session, const Dialect& dialect, const RunRecord& run) {
  const int held = run.held ? 1 : 0;
  session << fmt::format(
      "insert into runs (name, machine, plan, controller, state, held, feed_override, plan_time, reason, create_time, "
      "change_time) values (:name, :machine, :plan, :controller, 0, :held, :feed_override, :plan_time, :reason, {0}, "
      "{0})",
      dialect.now()),
      soci::use(run.name, "name"), soci::use(run.machine, "machine"), soci::use(run.plan, "plan"),
      soci::use(run.controller, "controller"), soci::use(held, "held"), soci::use(run.feed_override, "feed_override"),
      soci::use(run.plan_time, "plan_time"), soci::use(run.reason, "reason");
}

void update_run(soci::session& session, const Dialect& dialect, const RunRecord& run) {
  const int state = static_cast<int>(run.state);
  const int held = run.held ? 1 : 0;
  session << fmt::format(
      "update runs set controller = :controller, state = :state, held = :held, feed_override = :feed_override, "
      "plan_time = :plan_time, reason = :reason, change_time = {} where name = :name and state = 0",
      dialect.now()),
      soci::use(run.controller, "controller"), soci::use(state, "state"), soci::use(held, "held"),
      soci::use(run.feed_override, "feed_override"), soci::use(run.plan_time, "plan_time"),
      soci::use(run.reason, "reason"), soci::use(run.name, "name");
}

void delete_old_runs(soci::session& session, const Dialect& dialect, long long age) {
  session << fmt::format("delete from runs where state <> 0 and change_time < {} - {}", dialect.now(), age);
}

}  // namespace kcs::store
