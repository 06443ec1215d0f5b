// What is said to the database about one run. What inserts or updates belongs into a transaction on its plan's name: so
// the plan is not forgotten in between.
#pragma once

#include <optional>
#include <string>

#include "server/store/connections.h"
#include "server/store/run_record.h"

namespace kcs::store {

std::optional<RunRecord> select_run(soci::session& session, const std::string& name);
std::optional<RunRecord> select_open_run(soci::session& session, const std::string& machine);

// The number of the machine's next run. Whoever else asks for one waits until this transaction has ended.
long long take_run_number(soci::session& session, const std::string& machine);

// As an open run whose create_time is now. The machine must have no other open one.
void insert_run(soci::session& session, const Dialect& dialect, const RunRecord& run);

// Writes what may change, if the run is open.
void update_run(soci::session& session, const Dialect& dialect, const RunRecord& run);

// Those that were over so many µs ago.
void delete_old_runs(soci::session& session, const Dialect& dialect, long long age);

}  // namespace kcs::store
