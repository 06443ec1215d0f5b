// What is said to the database about one plan. What inserts, settles or deletes belongs into a transaction on its name.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "server/store/connections.h"
#include "server/store/records.h"
#include "server/store/request_rows.h"

namespace kcs::store {

// Where a Record is read from: "o", what each owner knows of a plan, or for everybody's once what its first owner
// knows, and "p", the plan itself. Rows of one owner must still meet condition_of(whose).
std::string record_tables(const Whose& whose);
// Its parameter is :owner, if there is one owner.
std::string condition_of(const Whose& whose);

// The columns of a Record: those of these tables, in the order in which RecordRow takes them.
std::string record_columns(const Dialect& dialect);

// One row of these columns. Their parameter :planner is the server that asks.
struct RecordRow {
  std::string name;
  int state = 0;
  long long create_time = 0;
  std::string outcome;
  int to_plan = 0;

  // Has the columns of each fetched row written here, which must live as long as the statement.
  void receive(soci::statement& statement);
  Record record(const Dialect& dialect) const;
};

// Executes a statement whose parameters and results are known; its rows are fetched afterwards.
void run(soci::statement& statement, const std::string& sql);

std::optional<Record> select_plan(soci::session& session, const Dialect& dialect, const std::string& planner,
                                  const Whose& whose, const std::string& name);

bool has_plan(soci::session& session, const std::string& name);

// Unless they are there already.
void insert_plan(soci::session& session, const Dialect& dialect, const Request& request, const PackedRequest& packed);
void insert_owner(soci::session& session, const Dialect& dialect, const std::string& owner, const std::string& name);

// The plan is used now.
void touch_plan(soci::session& session, const Dialect& dialect, const std::string& name);

// An outcome that is there already stays, but for a refusal that is to be replaced.
enum class Refusal { kStays, kIsReplaced };
void settle_plan(soci::session& session, const Dialect& dialect, const std::string& name, State state,
                 std::string_view outcome, std::optional<double> cycle_time, Refusal refusal = Refusal::kStays);

// Of everybody's: all owners but runs.
Removal delete_owner(soci::session& session, const Whose& whose, const std::string& name);
// With all that belongs to it.
void delete_plan(soci::session& session, const std::string& name);

}  // namespace kcs::store
