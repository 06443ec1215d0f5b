// A database that outlives the kcsd of a test, and may be that of several.
#pragma once

#include <fmt/format.h>

#include <string>

#include "tests/files/temporary_folder.h"
#include "tests/store/postgres_server.h"

namespace kcs::test {

// The table [store] for a database, with short times: what is amiss is seen soon.
inline std::string store_settings(const std::string& database, const std::string& password_file = "") {
  return fmt::format("[store]\ndatabase = \"{}\"\npassword_file = \"{}\"\nlease_s = 1.0\ntimeout_s = 1.0\n", database,
                     password_file);
}

class SqliteStore {
 public:
  std::string settings() const { return store_settings("sqlite:" + (folder_.path() / "plans.db").string()); }

 private:
  TemporaryFolder folder_;
};

class PostgresqlStore {
 public:
  const std::string& settings() const { return settings_; }
  PostgresServer& server() { return server_; }

 private:
  PostgresServer server_;
  std::string settings_ = store_settings(server_.create_database("plans"), server_.password_file().string());
};

}  // namespace kcs::test
