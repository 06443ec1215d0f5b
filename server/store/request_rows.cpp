#include "server/store/request_rows.h"

#include <fmt/format.h>

#include "server/store/compression.h"

namespace kcs::store {
namespace {

// Of a row before it is compressed. Larger ones hardly get smaller in all.
constexpr std::size_t kRowBytes = 2 << 20;

}  // namespace

PackedRequest::PackedRequest(std::string_view bytes) {
  for (std::size_t begin = 0; begin < bytes.size(); begin += kRowBytes) {
    rows_.push_back(compress(bytes.substr(begin, kRowBytes)));
  }
}

std::uint64_t PackedRequest::bytes() const {
  std::uint64_t sum = 0;
  for (const std::string& row : rows_) sum += row.size();
  return sum;
}

void PackedRequest::insert(soci::session& session, const Dialect& dialect, const std::string& name) const {
  const std::string statement =
      fmt::format("insert into request_rows (name, position, bytes) values (:name, :position, {})",
                  dialect.bytes_of_parameter(":bytes"));
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    const std::string bytes = dialect.encode(rows_[i]);
    const int position = static_cast<int>(i);
    session << statement, soci::use(name, "name"), soci::use(position, "position"), soci::use(bytes, "bytes");
  }
}

std::optional<std::string> read_request(Connections& connections, const std::string& name) {
  const Dialect& dialect = connections.dialect();
  return connections.read([&](soci::session& session) -> std::optional<std::string> {
    long long size = 0;
    session << "select request_bytes from plans where name = :name", soci::use(name, "name"), soci::into(size);
    if (!session.got_data()) return std::nullopt;
    const std::string statement = fmt::format("select {} from request_rows where name = :name and position = :position",
                                              dialect.string_of_column("bytes"));
    std::string bytes;
    bytes.reserve(static_cast<std::size_t>(size));
    for (int position = 0; bytes.size() < static_cast<std::size_t>(size); ++position) {
      std::string row;
      session << statement, soci::use(name, "name"), soci::use(position, "position"), soci::into(row);
      if (!session.got_data()) return std::nullopt;  // it was removed meanwhile
      bytes += decompress(dialect.decode(std::move(row)), kRowBytes);
    }
    return bytes;
  });
}

void delete_request(soci::session& session, const std::string& name) {
  session << "delete from request_rows where name = :name", soci::use(name, "name");
}

}  // namespace kcs::store
