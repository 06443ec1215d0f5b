// What differs between the databases. Everything else in the store is the same SQL for all of them.
#pragma once

#include <soci/soci.h>

#include <cstddef>
#include <memory>
#include <mutex>
#include <string>
#include <string_view>

#include "server/store/settings.h"

namespace kcs::store {

// What an error of the database means for the store.
enum class Fault {
  kDisconnected,  // this connection is gone, another one may work
  kBusy,          // later it may work
  kFull,          // the disk
  kOther,         // it will not work
};

class Dialect {
 public:
  using Turn = std::unique_lock<std::timed_mutex>;

  virtual ~Dialect() = default;

  // The database, to be named in messages; without passwords.
  virtual std::string description() const = 0;
  // How many connections can be open to it.
  virtual std::size_t most_connections() const = 0;
  // Connects a session that is closed. Throws StoreError or soci::soci_error.
  virtual void open(soci::session& session) const = 0;
  // The socket of a connection; −1 if it has none.
  virtual int socket(soci::session& session) const = 0;
  virtual Fault fault(const soci::soci_error& error) const = 0;

  // Waits for the turn to write, where transactions of this process had better come one after the other; held until
  // the transaction has ended. Throws StoreUnavailable if it does not come in time.
  virtual Turn turn() const = 0;
  // Begins a transaction that writes. One at a time runs on the same subject, and sees what those before it wrote.
  virtual void begin(soci::session& session, const std::string& subject) const = 0;
  // Gives some of the room that became free back to the disk, where the database does not do it by itself, in turn with
  // other writers. False if there is no more.
  virtual bool shrink(soci::session& session) const = 0;

  // Whether other processes have the database open as kcsd does; not within a transaction. Whoever is about to connect
  // is not seen.
  virtual bool has_other_users(soci::session& session) const = 0;

  // SQL: the time now, µs since 1970.
  virtual std::string now() const = 0;
  // SQL: the type of a column of bytes.
  virtual std::string_view bytes_type() const = 0;
  // SQL: the bytes in a parameter, and the string from a column of bytes. They travel as encode() makes them.
  virtual std::string bytes_of_parameter(std::string_view parameter) const = 0;
  virtual std::string string_of_column(std::string_view column) const = 0;
  virtual std::string encode(std::string bytes) const = 0;
  virtual std::string decode(std::string text) const = 0;
};

// The dialect for settings.database. Throws StoreError if that says nothing sensible.
std::unique_ptr<const Dialect> make_dialect(const StoreSettings& settings);

}  // namespace kcs::store
