#include "server/store/dialect.h"

#include <fmt/format.h>

#include "server/store/errors.h"
#include "server/store/postgresql.h"
#include "server/store/sqlite.h"

namespace kcs::store {

std::unique_ptr<const Dialect> make_dialect(const StoreSettings& settings) {
  constexpr std::string_view kSqlite = "sqlite:";
  constexpr std::string_view kPostgresql = "postgresql:";
  const std::string_view database = settings.database;
  if (database == "memory") return std::make_unique<Sqlite>(kInMemory, settings.timeout);
  if (database == "sqlite") return std::make_unique<Sqlite>(default_file(), settings.timeout);
  if (database.starts_with(kSqlite) && database.size() > kSqlite.size()) {
    return std::make_unique<Sqlite>(std::string(database.substr(kSqlite.size())), settings.timeout);
  }
  if (database.starts_with(kPostgresql)) return std::make_unique<Postgresql>(settings);
  throw StoreError(fmt::format(
      "\"{}\" is no database: use \"sqlite\", \"sqlite:PATH\", \"postgresql:CONNINFO\" or \"memory\"", database));
}

void check_database(const std::string& database) { make_dialect({.database = database}); }

}  // namespace kcs::store
