#include "server/store/sqlite.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <soci/sqlite3/soci-sqlite3.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <filesystem>
#include <limits>
#include <system_error>
#include <thread>
#include <utility>

#include "server/store/errors.h"

namespace kcs::store {
namespace {

namespace fs = std::filesystem;

// One large transaction leaves a log of its size; it is cut to so many bytes once its content is in the file.
constexpr std::int64_t kKeptLog = 16 << 20;
// Pages of 4 KiB that are given back to the disk in one transaction, so that none keeps other writers waiting for long.
constexpr int kPagesAtOnce = 4096;

fs::path state_directory() {
  // systemd separates several of them by colons.
  if (const char* given = std::getenv("STATE_DIRECTORY"); given && *given) {
    const std::string_view all = given;
    return all.substr(0, all.find(':'));
  }
  if (const char* given = std::getenv("XDG_STATE_HOME"); given && *given) return fs::path(given) / "kcs";
  if (const char* home = std::getenv("HOME"); home && *home) return fs::path(home) / ".local/state/kcs";
  throw StoreError(
      "no place for the store: neither STATE_DIRECTORY nor XDG_STATE_HOME nor HOME is set; "
      "give one as database = \"sqlite:PATH\"");
}

// How long to let others go on before the journal is asked for again.
constexpr std::chrono::milliseconds kPause{5};

// SQLite waits for its turn to write, but not here: it reads already, and might wait for somebody who waits for it.
void keep_log(soci::session& session, std::chrono::milliseconds timeout) {
  const auto last_try = std::chrono::steady_clock::now() + timeout;
  for (;; std::this_thread::sleep_for(kPause)) {
    try {
      session << "pragma journal_mode = wal";
      return;
    } catch (const soci::sqlite3_soci_error& error) {
      if (error.result() != SQLITE_BUSY || std::chrono::steady_clock::now() >= last_try) throw;
    }
  }
}

// Programs are trade secrets: the file is its user's alone. SQLite gives its side files the same rights.
void make_file(const fs::path& file) {
  std::error_code failed;
  fs::create_directories(file.parent_path(), failed);
  const int descriptor = failed ? -1 : ::open(file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0600);
  if (descriptor < 0) {
    const std::string reason = failed ? failed.message() : std::generic_category().message(errno);
    throw StoreError(
        fmt::format("cannot open the store's file {}: {}; give this user the right to write there, or another place in "
                    "the settings",
                    file.string(), reason));
  }
  ::close(descriptor);
}

}  // namespace

std::string default_file() { return state_directory() / "plans.db"; }

Sqlite::Sqlite(const std::string& file, std::chrono::milliseconds timeout)
    : file_(file == kInMemory ? file : fs::absolute(file).string()), timeout_(timeout) {}

std::string Sqlite::description() const { return file_ == kInMemory ? "in memory" : file_; }

std::size_t Sqlite::most_connections() const {
  return file_ == kInMemory ? 1 : std::numeric_limits<std::size_t>::max();
}

void Sqlite::open(soci::session& session) const {
  if (file_ != kInMemory) make_file(file_);
  session.open(soci::sqlite3, file_);
  session << fmt::format("pragma busy_timeout = {}", timeout_.count());
  int is_incremental = 0;
  session << "pragma auto_vacuum", soci::into(is_incremental);
  // Saying it again would wait for a turn to write.
  if (!is_incremental) session << "pragma auto_vacuum = incremental";
  keep_log(session, timeout_);
  session << "pragma synchronous = full";  // without it a power failure may take the last transactions
  session << fmt::format("pragma journal_size_limit = {}", kKeptLog);
  session << "pragma secure_delete = fast";  // Debian's default writes as much to remove a request as to keep it
}

int Sqlite::socket(soci::session& /*session*/) const { return -1; }

Fault Sqlite::fault(const soci::soci_error& error) const {
  const auto* failed = dynamic_cast<const soci::sqlite3_soci_error*>(&error);
  switch (failed ? failed->result() : SQLITE_ERROR) {
    case SQLITE_FULL:
      return Fault::kFull;
    case SQLITE_BUSY:
    case SQLITE_LOCKED:
    case SQLITE_PROTOCOL:
    case SQLITE_NOMEM:
    case SQLITE_IOERR:
      return Fault::kBusy;
    default:
      return Fault::kOther;
  }
}

Dialect::Turn Sqlite::turn() const {
  // By this clock, for ThreadSanitizer does not know the call that waits by the steady one.
  Turn turn(writing_, std::chrono::system_clock::now() + timeout_);
  if (!turn) {
    throw StoreUnavailable(fmt::format("the store's database ({}): others have been writing for {} ms; try again later",
                                       description(), timeout_.count()));
  }
  return turn;
}

void Sqlite::begin(soci::session& session, const std::string& /*subject*/) const {
  // Takes the only lock for writing at once: a reader that became a writer later could meet another one and fail.
  session << "begin immediate";
}

bool Sqlite::shrink(soci::session& session) const {
  namespace api = sqlite_api;
  int before = 0;
  session << "pragma freelist_count", soci::into(before);
  if (before == 0) return false;
  api::sqlite3* const connection = static_cast<soci::sqlite3_session_backend*>(session.get_backend())->conn_;
  // SOCI would take the first step of this statement only, which is the first page.
  const std::string statement = fmt::format("pragma incremental_vacuum({})", kPagesAtOnce);
  const int result = api::sqlite3_exec(connection, statement.c_str(), nullptr, nullptr, nullptr);
  if (result != SQLITE_OK) throw soci::sqlite3_soci_error(api::sqlite3_errmsg(connection), result);
  int after = 0;
  session << "pragma freelist_count", soci::into(after);
  return after > 0 && after < before;  // a file that was made otherwise gives nothing back
}

bool Sqlite::has_other_users(soci::session& session) const {
  try {
    // Only who has the file alone may do without its log, until open() asks for it again.
    session << "pragma journal_mode = delete";
    return false;
  } catch (const soci::sqlite3_soci_error& error) {
    if (error.result() == SQLITE_BUSY) return true;
    throw;
  }
}

std::string Sqlite::now() const {
  // SQLite's own clock counts milliseconds.
  const auto since_1970 = std::chrono::system_clock::now().time_since_epoch();
  return std::to_string(std::chrono::duration_cast<std::chrono::microseconds>(since_1970).count());
}

std::string_view Sqlite::bytes_type() const { return "blob"; }

std::string Sqlite::bytes_of_parameter(std::string_view parameter) const {
  return fmt::format("cast({} as blob)", parameter);
}

std::string Sqlite::string_of_column(std::string_view column) const { return std::string(column); }

std::string Sqlite::encode(std::string bytes) const { return bytes; }

std::string Sqlite::decode(std::string text) const { return text; }

}  // namespace kcs::store
