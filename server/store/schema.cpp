#include "server/store/schema.h"

#include <fmt/format.h>

#include "server/store/errors.h"
#include "server/store/schema_steps.h"

namespace kcs::store {
namespace {

using Steps = std::array<SchemaStep, kSchemaVersion>;

// One change at a time.
constexpr const char* kSubject = "schema";

int version_in(soci::session& session) {
  session << "create table if not exists kcs_schema (version integer not null)";
  session << "insert into kcs_schema (version) select 0 where not exists (select 1 from kcs_schema)";
  int version = 0;
  session << "select version from kcs_schema", soci::into(version);
  return version;
}

void run(soci::session& session, const std::vector<std::string>& statements, int new_version) {
  for (const std::string& statement : statements) session << statement;
  session << fmt::format("update kcs_schema set version = {}", new_version);
}

void go_forward(soci::session& session, const Steps& steps, int from, int to) {
  for (int version = from; version < to; ++version) run(session, steps[version].forward, version + 1);
}

std::vector<std::string> go_back(soci::session& session, const Steps& steps, int from, int to) {
  std::vector<std::string> lost;
  for (int version = from; version > to; --version) {
    const SchemaStep& step = steps[version - 1];
    run(session, step.back, version - 1);
    if (!step.lost.empty()) lost.push_back(step.lost);
  }
  return lost;
}

[[noreturn]] void refuse_newer(const Dialect& dialect, int version) {
  throw StoreError(fmt::format(
      "the store's database ({}) was made by a newer kcsd: its tables have version {}, this kcsd can use them up to "
      "version {}; start the newer one, or stop all and have the newer one take the tables back: kcsd --schema {}",
      dialect.description(), version, kSchemaVersion, kSchemaVersion));
}

}  // namespace

void prepare_schema(Connections& connections) {
  const Dialect& dialect = connections.dialect();
  connections.write(kSubject, [&dialect](soci::session& session) {
    const int version = version_in(session);
    int usable_from = 0;
    if (version > kSchemaVersion) session << "select usable_from from kcs_schema", soci::into(usable_from);
    if (usable_from > kSchemaVersion) refuse_newer(dialect, version);
    go_forward(session, schema_steps(dialect), version, kSchemaVersion);
    return true;
  });
}

SchemaChange move_schema(Connections& connections, int version) {
  const Dialect& dialect = connections.dialect();
  if (version < 1 || version > kSchemaVersion) {
    throw StoreError(
        fmt::format("there is no version {} of the store's tables: this kcsd knows 1 to {}", version, kSchemaVersion));
  }
  const bool is_shared =
      connections.read([&dialect](soci::session& session) { return dialect.has_other_users(session); });
  return connections.write(kSubject, [&](soci::session& session) {
    const int found = version_in(session);
    if (found > kSchemaVersion) refuse_newer(dialect, found);
    if (found == 0) {
      throw StoreError(fmt::format("the store's database ({}) has no tables of kcsd: see whether it is the right one",
                                   dialect.description()));
    }
    if (found > version && is_shared) {
      throw StoreError(
          fmt::format("the store's database ({}) is in use: stop every kcsd that has it before its tables go back from "
                      "version {} to {}",
                      dialect.description(), found, version));
    }
    go_forward(session, schema_steps(dialect), found, version);
    return SchemaChange{.from = found, .lost = go_back(session, schema_steps(dialect), found, version)};
  });
}

}  // namespace kcs::store
