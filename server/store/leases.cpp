#include "server/store/leases.h"

#include <fmt/format.h>

#include <algorithm>
#include <random>

namespace kcs::store {
namespace {

// Claims of several servers go one after the other.
constexpr const char* kSubject = "leases";

std::string unique_word() {
  std::random_device random;
  return fmt::format("{:08x}{:08x}{:08x}{:08x}", random(), random(), random(), random());
}

}  // namespace

Leases::Leases(std::chrono::milliseconds duration)
    : duration_(std::chrono::microseconds(duration).count()), planner_(unique_word()) {}

void Leases::take(soci::session& session, const Dialect& dialect, const std::string& name) const {
  const std::string now = dialect.now();
  session << fmt::format(
      "update plans set planner = :planner, lease_end = {} + {} where name = :name and state = 0 and lease_end < {}",
      now, duration_, now),
      soci::use(planner_, "planner"), soci::use(name, "name");
}

std::vector<std::string> Leases::claim(Connections& connections, std::size_t most) const {
  const Dialect& dialect = connections.dialect();
  const auto limit = static_cast<long long>(most);
  return connections.write(kSubject, [&](soci::session& session) {
    const std::string now = dialect.now();
    session << fmt::format("update plans set lease_end = {} + {} where state = 0 and planner = :planner", now,
                           duration_),
        soci::use(planner_, "planner");
    long long held = 0;
    session << "select count(*) from plans where state = 0 and planner = :planner", soci::use(planner_, "planner"),
        soci::into(held);
    const long long wanted = std::max(0LL, limit - held);
    // The condition stands in both places: an outcome may be written between the choice and the change.
    session << fmt::format(
        "update plans set planner = :planner, lease_end = {0} + {1} where state = 0 and lease_end < {0} and name in "
        "(select name from plans where state = 0 and lease_end < {0} order by accept_time limit :wanted)",
        now, duration_),
        soci::use(planner_, "planner"), soci::use(wanted, "wanted");
    std::vector<std::string> names;
    std::string name;
    soci::statement statement = (session.prepare << "select name from plans where state = 0 and planner = :planner "
                                                    "order by accept_time",
                                 soci::use(planner_, "planner"), soci::into(name));
    statement.execute();
    while (statement.fetch()) names.push_back(name);
    return names;
  });
}

void Leases::release(Connections& connections) const {
  connections.write(kSubject, [this](soci::session& session) {
    session << "update plans set lease_end = 0, planner = '' where state = 0 and planner = :planner",
        soci::use(planner_, "planner");
    return true;
  });
}

}  // namespace kcs::store
