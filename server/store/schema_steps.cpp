#include "server/store/schema_steps.h"

#include <fmt/format.h>

namespace kcs::store {
namespace {

SchemaStep plans(std::string_view bytes) {
  return {.forward = {fmt::format(R"(create table plans (
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
                                  bytes)}};
}

SchemaStep runs() {
  return {.forward = {R"(create table machines (
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
          // An open run owns its plan.
          .back = {"delete from owners where owner in (select name from runs)",
                   "delete from request_rows where name not in (select name from owners)",
                   "delete from plans where name not in (select name from owners)",  //
                   "drop table runs", "drop table machines"},
          .lost =
              "all runs of machines, also open ones, which are not resumed, with plans that only those still kept; "
              "runs are numbered from 1 again"};
}

SchemaStep oldest_user() {
  return {.forward = {"alter table kcs_schema add column usable_from integer not null default 3"},
          .back = {"alter table kcs_schema drop column usable_from"}};
}

}  // namespace

std::array<SchemaStep, kSchemaVersion> schema_steps(const Dialect& dialect) {
  return {plans(dialect.bytes_type()), runs(), oldest_user()};
}

}  // namespace kcs::store
