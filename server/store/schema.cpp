#include "server/store/schema.h"

#include <fmt/format.h>

#include <string>
#include <vector>

#include "server/store/errors.h"

namespace kcs::store {
namespace {

using Statements = std::vector<std::string>;

// What leads from each version to the next. A version that was released never changes: a new one is added.
std::vector<Statements> steps(const Dialect& dialect) {
  const std::string_view bytes = dialect.bytes_type();
  return {
      {fmt::format(R"(create table plans (
                        name text primary key,
                        machine_name text not null,
                        state smallint not null,
                        cycle_time double precision,
                        outcome {} not null,
                        request_bytes bigint not null,
                        stored_bytes bigint not null,
                        accept_time bigint not null,
                        use_time bigint not null,
                        planner text not null,
                        lease_end bigint not null))",
                   bytes),
       "create index plans_by_use on plans (use_time)",
       "create index plans_to_plan on plans (accept_time) where state = 0",
       R"(create table owners (
            owner text not null,
            name text not null,
            create_time bigint not null,
            primary key (owner, name)))",
       "create index owners_by_plan on owners (name)",
       "create index owners_by_time on owners (owner, create_time, name)",
       fmt::format(R"(create table request_rows (
                        name text not null,
                        position integer not null,
                        bytes {} not null,
                        primary key (name, position)))",
                   bytes)},
      {R"(create table machines (
            machine text primary key,
            runs bigint not null))",
       R"(create table runs (
            name text primary key,
            machine text not null,
            plan text not null,
            controller text not null,
            state smallint not null,
            held smallint not null,
            feed_override double precision not null,
            plan_time double precision not null,
            reason text not null,
            create_time bigint not null,
            change_time bigint not null))",
       "create unique index open_runs on runs (machine) where state = 0",
       "create index ended_runs on runs (change_time) where state <> 0"},
  };
}

std::size_t version_in(soci::session& session) {
  session << "create table if not exists kcs_schema (version integer not null)";
  int version = 0;
  session << "select coalesce(max(version), 0) from kcs_schema", soci::into(version);
  return static_cast<std::size_t>(version);
}

}  // namespace

void prepare_schema(Connections& connections) {
  const std::vector<Statements> all = steps(connections.dialect());
  const std::size_t version = connections.write("schema", [&all](soci::session& session) {
    const std::size_t found = version_in(session);
    for (std::size_t step = found; step < all.size(); ++step) {
      for (const std::string& statement : all[step]) session << statement;
      session << "delete from kcs_schema";
      session << fmt::format("insert into kcs_schema (version) values ({})", step + 1);
    }
    return found;
  });
  if (version > all.size()) {
    throw StoreError(fmt::format(
        "the store's database ({}) was made by a newer kcsd: its schema has version {}, this kcsd knows {}; "
        "start the newer one, or give this one a database of its own",
        connections.dialect().description(), version, all.size()));
  }
}

}  // namespace kcs::store
