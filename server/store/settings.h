// The settings of the store.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <string>

namespace kcs::store {

struct StoreSettings {
  // Where requests and their outcomes are kept:
  //   "sqlite"               the file plans.db in the state directory: $STATE_DIRECTORY (systemd sets it), else
  //                          $XDG_STATE_HOME/kcs, else ~/.local/state/kcs
  //   "sqlite:PATH"          this file, on a local disk (locks over a network file system cannot be trusted)
  //   "postgresql:CONNINFO"  a PostgreSQL database, 11 or later, in libpq's words ("postgresql:host=db dbname=kcs
  //                          user=kcs") or as a URI ("postgresql://kcs@db/kcs"); several servers may share it
  //   "memory"               nowhere: it is gone with the process
  std::string database = "sqlite";
  // A file with the password for PostgreSQL, alone on its first line; read anew for each connection. Empty: none.
  std::string password_file;
  // Connections that are open at the same time at most, ≥ 1; a call beyond waits for one.
  std::size_t connections = 8;
  // How long a call waits for a connection, for a lock or for one statement, ≥ 1 s. A whole call takes four times as
  // long at most, then its connection is cut.
  std::chrono::milliseconds timeout = std::chrono::seconds(10);
  // A request whose server gave no sign of life for so long is planned by another server that shares the store, or by
  // the same one after it was started again.
  std::chrono::milliseconds lease = std::chrono::seconds(30);
  // What was not used for longer is forgotten, and runs that were over for longer. Use is noted to a 24th of this.
  std::chrono::seconds keep = std::chrono::hours(24 * 30);
  // Compressed requests and their outcomes. Beyond, what was not used for longest is forgotten.
  std::uint64_t keep_bytes = std::uint64_t{10} << 30;
};

// Throws StoreError, which says what is allowed, unless `database` has one of the forms above.
void check_database(const std::string& database);

}  // namespace kcs::store
