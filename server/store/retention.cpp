#include "server/store/retention.h"

#include <fmt/format.h>

#include <cstdint>

#include "server/store/plan_rows.h"
#include "server/store/run_rows.h"

namespace kcs::store {
namespace {

// Plans that one sweep forgets, so that it does not keep the store busy for long.
constexpr int kPlansAtOnce = 500;

struct Candidate {
  std::string name;
  long long use_time = 0;
  long long bytes = 0;
};

// Those that are too old, and of the rest the oldest until the others are within the bound.
std::vector<Candidate> candidates(Connections& connections, const StoreSettings& settings) {
  const auto age = std::chrono::microseconds(settings.keep).count();
  return connections.read([&](soci::session& session) {
    double bytes = 0;  // a sum is a decimal number in PostgreSQL
    session << "select coalesce(sum(stored_bytes), 0) from plans", soci::into(bytes);
    auto excess = static_cast<long long>(bytes - static_cast<double>(settings.keep_bytes));
    std::vector<Candidate> found;
    Candidate row;
    int is_old = 0;
    soci::statement statement =
        (session.prepare << fmt::format(
             "select name, use_time, stored_bytes, case when use_time < {} - {} then 1 else 0 end from plans "
             "where state <> 0 and name not in (select plan from runs where state = 0) order by use_time limit {}",
             connections.dialect().now(), age, kPlansAtOnce),
         soci::into(row.name), soci::into(row.use_time), soci::into(row.bytes), soci::into(is_old));
    statement.execute();
    while (statement.fetch() && (is_old || excess > 0)) {
      found.push_back(row);
      excess -= row.bytes;
    }
    return found;
  });
}

// False if it was used meanwhile, as by a new run, or somebody else forgot it.
bool forget(Connections& connections, const Candidate& candidate) {
  return connections.write(candidate.name, [&candidate](soci::session& session) {
    int unused = 0;
    session << "select count(*) from plans where name = :name and use_time = :use_time",
        soci::use(candidate.name, "name"), soci::use(candidate.use_time, "use_time"), soci::into(unused);
    if (unused == 0) return false;
    delete_plan(session, candidate.name);
    return true;
  });
}

// Those that are over change no more, so none has to wait.
void forget_runs(Connections& connections, std::chrono::seconds keep) {
  connections.write("old runs", [&](soci::session& session) {
    delete_old_runs(session, connections.dialect(), std::chrono::microseconds(keep).count());
    return true;
  });
}

}  // namespace

std::vector<std::string> sweep(Connections& connections, const StoreSettings& settings) {
  std::vector<std::string> forgotten;
  for (const Candidate& candidate : candidates(connections, settings)) {
    if (forget(connections, candidate)) forgotten.push_back(candidate.name);
  }
  forget_runs(connections, settings.keep);
  connections.shrink();
  return forgotten;
}

}  // namespace kcs::store
