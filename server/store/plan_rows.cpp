#include "server/store/plan_rows.h"

#include <fmt/format.h>

namespace kcs::store {

std::string record_tables(const Whose& whose) {
  return fmt::format("{} o join plans p on p.name = o.name",
                     whose ? "owners" : "(select name, min(create_time) create_time from owners group by name)");
}

std::string condition_of(const Whose& whose) { return whose ? "o.owner = :owner" : "1 = 1"; }

std::string record_columns(const Dialect& dialect) {
  return fmt::format(
      "p.name, p.state, o.create_time, {}, case when p.state = 0 and p.planner = :planner then 1 else 0 end",
      dialect.string_of_column("p.outcome"));
}

void RecordRow::receive(soci::statement& statement) {
  statement.exchange(soci::into(name));
  statement.exchange(soci::into(state));
  statement.exchange(soci::into(create_time));
  statement.exchange(soci::into(outcome));
  statement.exchange(soci::into(to_plan));
}

void run(soci::statement& statement, const std::string& sql) {
  statement.alloc();
  statement.prepare(sql, soci::details::st_one_time_query);
  statement.define_and_bind();
  statement.execute();
}

Record RecordRow::record(const Dialect& dialect) const {
  return {.name = name,
          .state = static_cast<State>(state),
          .create_time = Time(std::chrono::microseconds(create_time)),
          .outcome = dialect.decode(outcome),
          .to_plan = to_plan != 0};
}

std::optional<Record> select_plan(soci::session& session, const Dialect& dialect, const std::string& planner,
                                  const Whose& whose, const std::string& name) {
  RecordRow row;
  soci::statement statement(session);
  statement.exchange(soci::use(planner, "planner"));
  if (whose) statement.exchange(soci::use(*whose, "owner"));
  statement.exchange(soci::use(name, "name"));
  row.receive(statement);
  run(statement, fmt::format("select {} from {} where {} and o.name = :name", record_columns(dialect),
                             record_tables(whose), condition_of(whose)));
  if (!statement.fetch()) return std::nullopt;
  return row.record(dialect);
}

bool has_plan(soci::session& session, const std::string& name) {
  int count = 0;
  session << "select count(*) from plans where name = :name", soci::use(name, "name"), soci::into(count);
  return count > 0;
}

void insert_plan(soci::session& session, const Dialect& dialect, const Request& request, const PackedRequest& packed) {
  if (has_plan(session, request.name)) return;
  const std::string now = dialect.now();
  const auto request_bytes = static_cast<long long>(request.bytes.size());
  const auto stored_bytes = static_cast<long long>(packed.bytes());
  session << fmt::format(
      "insert into plans (name, machine_name, state, outcome, request_bytes, stored_bytes, accept_time, use_time, "
      "planner, lease_end) values (:name, :machine_name, 0, {}, :request_bytes, :stored_bytes, {}, {}, '', 0)",
      dialect.bytes_of_parameter("''"), now, now),
      soci::use(request.name, "name"), soci::use(request.machine_name, "machine_name"),
      soci::use(request_bytes, "request_bytes"), soci::use(stored_bytes, "stored_bytes");
  packed.insert(session, dialect, request.name);
}

void insert_owner(soci::session& session, const Dialect& dialect, const std::string& owner, const std::string& name) {
  session << fmt::format(
      "insert into owners (owner, name, create_time) values (:owner, :name, {}) on conflict (owner, name) do nothing",
      dialect.now()),
      soci::use(owner, "owner"), soci::use(name, "name");
}

void touch_plan(soci::session& session, const Dialect& dialect, const std::string& name) {
  session << fmt::format("update plans set use_time = {} where name = :name", dialect.now()), soci::use(name, "name");
}

void settle_plan(soci::session& session, const Dialect& dialect, const std::string& name, State state,
                 std::string_view outcome, std::optional<double> cycle_time, Refusal refusal) {
  const int new_state = static_cast<int>(state);
  const double seconds = cycle_time.value_or(0);
  soci::indicator has_seconds = cycle_time ? soci::i_ok : soci::i_null;
  const auto outcome_bytes = static_cast<long long>(outcome.size());
  const int replaced = static_cast<int>(refusal == Refusal::kIsReplaced ? State::kRefused : State::kAccepted);
  const std::string bytes = dialect.encode(std::string(outcome));
  session << fmt::format(
      "update plans set state = :state, cycle_time = :cycle_time, outcome = {}, use_time = {}, "
      "stored_bytes = stored_bytes + :outcome_bytes - length(outcome) where name = :name and state in (0, :replaced)",
      dialect.bytes_of_parameter(":outcome"), dialect.now()),
      soci::use(new_state, "state"), soci::use(seconds, has_seconds, "cycle_time"), soci::use(bytes, "outcome"),
      soci::use(outcome_bytes, "outcome_bytes"), soci::use(name, "name"), soci::use(replaced, "replaced");
}

Removal delete_owner(soci::session& session, const Whose& whose, const std::string& name) {
  if (whose) {
    int his = 0;
    session << "select count(*) from owners where owner = :owner and name = :name", soci::use(*whose, "owner"),
        soci::use(name, "name"), soci::into(his);
    if (his == 0) return Removal::kNotFound;
    session << "delete from owners where owner = :owner and name = :name", soci::use(*whose, "owner"),
        soci::use(name, "name");
  } else {
    if (!has_plan(session, name)) return Removal::kNotFound;
    session << "delete from owners where name = :name and owner not in (select name from runs where state = 0)",
        soci::use(name, "name");
  }
  int left = 0;
  session << "select count(*) from owners where name = :name", soci::use(name, "name"), soci::into(left);
  if (left > 0) return Removal::kOthersKeepIt;
  delete_plan(session, name);
  return Removal::kGone;
}

void delete_plan(soci::session& session, const std::string& name) {
  session << "delete from owners where name = :name", soci::use(name, "name");
  delete_request(session, name);
  session << "delete from plans where name = :name", soci::use(name, "name");
}

}  // namespace kcs::store
