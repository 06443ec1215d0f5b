#include "tests/store/store_test.h"

#include <fmt/format.h>
#include <sqlite3.h>

#include <memory>
#include <random>
#include <stdexcept>

namespace kcs::store {

test::PostgresServer& postgres() {
  static test::PostgresServer server;
  return server;
}

StoreSettings new_database(Kind kind, const test::TemporaryFolder& folder) {
  if (kind == Kind::kSqlite) return {.database = "sqlite:" + (folder.path() / "state/plans.db").string()};
  static int count = 0;
  return {.database = postgres().create_database(fmt::format("test_{}", ++count)),
          .password_file = postgres().password_file()};
}

std::string query(const StoreSettings& settings, const std::string& statement) {
  constexpr std::string_view kSqlite = "sqlite:";
  if (!settings.database.starts_with(kSqlite)) {
    return postgres().query(settings.database.substr(settings.database.rfind('=') + 1), statement);
  }
  sqlite3* opened = nullptr;
  const int failed = sqlite3_open(settings.database.substr(kSqlite.size()).c_str(), &opened);
  const std::unique_ptr<sqlite3, decltype(&sqlite3_close)> session(opened, &sqlite3_close);
  std::string value;
  const auto take = [](void* target, int, char** values, char**) {
    *static_cast<std::string*>(target) = values[0] ? values[0] : "";
    return 0;
  };
  if (failed || sqlite3_exec(opened, statement.c_str(), take, &value, nullptr) != SQLITE_OK) {
    throw std::runtime_error(statement + ": " + sqlite3_errmsg(opened));
  }
  return value;
}

std::string plan_name(std::uint64_t number) { return fmt::format("plans/{:064x}", number * 0x9e3779b97f4a7c15); }

std::string some_bytes(std::uint64_t number, std::size_t size) {
  std::mt19937_64 random(number);
  std::string bytes(size, '\0');
  for (std::size_t i = 0; i < size; ++i) bytes[i] = static_cast<char>(i % 2 ? random() : i / 256);
  return bytes;
}

Record accept(Store& store, const std::string& owner, std::uint64_t number, std::string_view bytes) {
  return store.accept(owner, {.name = plan_name(number), .machine_name = "mill", .bytes = bytes});
}

Record accept_finished(Store& store, const std::string& owner, std::uint64_t number, double cycle_time,
                       const std::string& machine_name) {
  return store.accept_finished(owner, {.name = plan_name(number), .machine_name = machine_name, .bytes = "request"},
                               {.plan = "plan", .cycle_time = cycle_time});
}

RunRecord run_of(std::uint64_t plan, const std::string& machine) {
  return {.machine = machine, .plan = plan_name(plan), .controller = "ada"};
}

std::vector<std::string> names(const std::vector<Record>& records) {
  std::vector<std::string> all;
  for (const Record& record : records) all.push_back(record.name);
  return all;
}

}  // namespace kcs::store
