#include "server/store/postgresql.h"

#include <fmt/format.h>
#include <libpq-fe.h>
#include <soci/postgresql/soci-postgresql.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <fstream>
#include <limits>
#include <map>
#include <memory>
#include <utility>

#include "server/store/errors.h"

namespace kcs::store {
namespace {

using Parameters = std::map<std::string, std::string>;

// What the settings say, in libpq's keywords.
Parameters parse(const std::string& database) {
  constexpr std::string_view kScheme = "postgresql:";
  const bool is_uri = database.starts_with("postgresql://");
  const std::string info = is_uri ? database : database.substr(kScheme.size());
  char* message = nullptr;
  const std::unique_ptr<PQconninfoOption, decltype(&PQconninfoFree)> options(PQconninfoParse(info.c_str(), &message),
                                                                             &PQconninfoFree);
  const std::unique_ptr<char, decltype(&PQfreemem)> reason(message, &PQfreemem);
  if (!options) {
    throw StoreError(
        fmt::format("the settings' database is nothing that PostgreSQL's library understands: {}; "
                    "use \"postgresql:host=HOST dbname=NAME user=NAME\" or \"postgresql://USER@HOST/NAME\"",
                    reason ? reason.get() : "out of memory"));
  }
  Parameters parameters;
  for (const PQconninfoOption* option = options.get(); option->keyword; ++option) {
    if (option->val) parameters[option->keyword] = option->val;
  }
  return parameters;
}

// SOCI would cut other forms than a URI at blanks.
std::string uri(const Parameters& parameters) {
  std::string text = "postgresql:///";
  for (const auto& [keyword, value] : parameters) {
    if (value.empty()) continue;
    text += (text.back() == '/' ? "?" : "&") + keyword + "=";
    for (const char character : value) {
      const bool is_plain = std::isalnum(static_cast<unsigned char>(character)) != 0;
      text += is_plain ? std::string(1, character) : fmt::format("%{:02X}", static_cast<unsigned char>(character));
    }
  }
  return text;
}

std::string password_in(const std::string& file) {
  std::ifstream stream(file);
  std::string password;
  if (!std::getline(stream, password)) {
    throw StoreUnavailable(
        fmt::format("cannot read the password of the store's database from {}: let this user read it", file));
  }
  return password;
}

constexpr std::string_view kDigits = "0123456789abcdef";

}  // namespace

Postgresql::Postgresql(const StoreSettings& settings)
    : parameters_(parse(settings.database)), password_file_(settings.password_file), timeout_(settings.timeout) {
  const auto whole_seconds = std::chrono::ceil<std::chrono::seconds>(timeout_).count();
  parameters_.try_emplace("connect_timeout", std::to_string(whole_seconds));
  parameters_.try_emplace("application_name", "kcsd");
  parameters_["client_encoding"] = "UTF8";
}

std::string Postgresql::description() const {
  std::string text = "PostgreSQL";
  for (const char* keyword : {"host", "hostaddr", "port", "dbname"}) {
    if (const auto given = parameters_.find(keyword); given != parameters_.end()) {
      text += fmt::format(" {}={}", keyword, given->second);
    }
  }
  return text;
}

std::size_t Postgresql::most_connections() const { return std::numeric_limits<std::size_t>::max(); }

void Postgresql::open(soci::session& session) const {
  Parameters parameters = parameters_;
  if (!password_file_.empty()) parameters["password"] = password_in(password_file_);
  session.open(soci::postgresql, uri(parameters));
  session << fmt::format("set statement_timeout = {}", timeout_.count());
  // A server that hangs or is gone without a word must not keep its locks.
  session << fmt::format("set idle_in_transaction_session_timeout = {}", timeout_.count());
  session << "set client_min_messages = warning";  // the library prints them to the standard error
}

int Postgresql::socket(soci::session& session) const {
  return PQsocket(static_cast<soci::postgresql_session_backend*>(session.get_backend())->conn_);
}

Fault Postgresql::fault(const soci::soci_error& error) const {
  const auto* failed = dynamic_cast<const soci::postgresql_soci_error*>(&error);
  if (!failed) return Fault::kDisconnected;  // it never was connected
  const std::string state = failed->sqlstate();
  const auto is_one_of = [&state](const auto& classes) {
    return std::ranges::any_of(classes, [&state](std::string_view begin) { return state.starts_with(begin); });
  };
  // Connection exceptions, shutdowns and crashes, time-outs between statements, a server that became read-only.
  constexpr std::array<std::string_view, 4> kDisconnected = {"08", "57P", "25P03", "25006"};
  // Conflicts and deadlocks, want of resources, locks, time-outs of statements, troubles of the operating system.
  constexpr std::array<std::string_view, 5> kBusy = {"40", "53", "55", "57", "58"};
  if (state == "53100") return Fault::kFull;
  if (is_one_of(kDisconnected)) return Fault::kDisconnected;
  return is_one_of(kBusy) ? Fault::kBusy : Fault::kOther;
}

Dialect::Turn Postgresql::turn() const { return {}; }

void Postgresql::begin(soci::session& session, const std::string& subject) const {
  session.begin();
  session << "select pg_advisory_xact_lock(hashtextextended(:subject, 0))", soci::use(subject, "subject");
}

bool Postgresql::shrink(soci::session& /*session*/) const { return false; }

bool Postgresql::has_other_users(soci::session& session) const {
  long long others = 0;
  session << "select count(*) from pg_stat_activity where datname = current_database() and pid <> pg_backend_pid() and "
             "application_name = current_setting('application_name')",
      soci::into(others);
  return others > 0;
}

std::string Postgresql::now() const { return "cast(extract(epoch from clock_timestamp()) * 1000000 as bigint)"; }

std::string_view Postgresql::bytes_type() const { return "bytea"; }

// SOCI passes text, which ends at a zero: so bytes travel as hexadecimal digits.
std::string Postgresql::bytes_of_parameter(std::string_view parameter) const {
  return fmt::format("decode({}, 'hex')", parameter);
}

std::string Postgresql::string_of_column(std::string_view column) const {
  return fmt::format("encode({}, 'hex')", column);
}

std::string Postgresql::encode(std::string bytes) const {
  std::string text(2 * bytes.size(), '\0');
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    const auto byte = static_cast<unsigned char>(bytes[i]);
    text[2 * i] = kDigits[byte >> 4];
    text[2 * i + 1] = kDigits[byte & 0xf];
  }
  return text;
}

std::string Postgresql::decode(std::string text) const {
  const auto value = [](char digit) { return digit <= '9' ? digit - '0' : digit - 'a' + 10; };
  std::string bytes(text.size() / 2, '\0');
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    bytes[i] = static_cast<char>(value(text[2 * i]) << 4 | value(text[2 * i + 1]));
  }
  return bytes;
}

}  // namespace kcs::store
