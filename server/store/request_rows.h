// The bytes of requests, as rows of the database.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "server/store/connections.h"

namespace kcs::store {

// The bytes of a request, compressed in pieces of bounded size: no row is too large for a database or for the memory.
class PackedRequest {
 public:
  explicit PackedRequest(std::string_view bytes);

  // What it takes.
  std::uint64_t bytes() const;
  void insert(soci::session& session, const Dialect& dialect, const std::string& name) const;

 private:
  std::vector<std::string> rows_;
};

// The bytes again, exactly; none if the request is not kept. Throws StoreError if a row is damaged.
std::optional<std::string> read_request(Connections& connections, const std::string& name);

// Inside a transaction.
void delete_request(soci::session& session, const std::string& name);

}  // namespace kcs::store
