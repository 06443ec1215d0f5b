// PostgreSQL: a server that several kcsd can share.
#pragma once

#include <chrono>
#include <cstddef>
#include <map>
#include <string>
#include <string_view>

#include "server/store/dialect.h"

namespace kcs::store {

// Transactions on the same subject wait for each other, no others do.
class Postgresql : public Dialect {
 public:
  // Throws StoreError if libpq does not understand settings.database.
  explicit Postgresql(const StoreSettings& settings);

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
  std::map<std::string, std::string> parameters_;  // of a connection, by libpq's keywords
  std::string password_file_;
  std::chrono::milliseconds timeout_;
};

}  // namespace kcs::store
