// SQLite: one file, embedded.
#pragma once

#include <chrono>
#include <cstddef>
#include <mutex>
#include <string>
#include <string_view>

#include "server/store/dialect.h"

namespace kcs::store {

// The file that is no file: a database in memory, which goes with its connection.
inline constexpr const char* kInMemory = ":memory:";

// Where "sqlite" keeps its file, see StoreSettings::database. Throws StoreError if the environment names no place.
std::string default_file();

// A write waits for the others in its turn; readers wait for nobody.
class Sqlite : public Dialect {
 public:
  // `file`: is made, readable by its user only, when it is opened first; its folder as well.
  Sqlite(const std::string& file, std::chrono::milliseconds timeout);

  std::string description() const override;
  std::size_t most_connections() const override;
  void open(soci::session& session) const override;
  int socket(soci::session& session) const override;
  Fault fault(const soci::soci_error& error) const override;
  Turn turn() const override;
  void begin(soci::session& session, const std::string& subject) const override;
  bool shrink(soci::session& session) const override;
  bool has_other_users(soci::session& session) const override;
  std::string now() const override;
  std::string_view bytes_type() const override;
  std::string bytes_of_parameter(std::string_view parameter) const override;
  std::string string_of_column(std::string_view column) const override;
  std::string encode(std::string bytes) const override;
  std::string decode(std::string text) const override;

 private:
  std::string file_;  // absolute, or kInMemory
  std::chrono::milliseconds timeout_;
  // Ahead of the file's own lock, for which threads wait in their sleep: some of them for seconds.
  mutable std::timed_mutex writing_;
};

}  // namespace kcs::store
