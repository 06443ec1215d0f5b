#include "server/store/connections.h"

#include <fmt/format.h>

#include <algorithm>

#include "server/store/errors.h"

namespace kcs::store {
namespace {

// A connection of the pool, lent.
class Lease {
 public:
  Lease(soci::connection_pool& pool, std::chrono::milliseconds timeout) : pool_(pool) {
    if (!pool_.try_lease(position_, static_cast<int>(timeout.count()))) {
      throw StoreUnavailable(
          fmt::format("all connections to the store's database were busy for {} ms: try again later, or raise the "
                      "number of connections in the settings",
                      timeout.count()));
    }
  }
  ~Lease() { pool_.give_back(position_); }
  Lease(const Lease&) = delete;
  Lease& operator=(const Lease&) = delete;

  soci::session& session() { return pool_.at(position_); }

 private:
  soci::connection_pool& pool_;
  std::size_t position_ = 0;
};

}  // namespace

Connections::Connections(const StoreSettings& settings)
    : dialect_(make_dialect(settings)),
      timeout_(settings.timeout),
      pool_(std::min(settings.connections, dialect_->most_connections())),
      watch_(4 * settings.timeout) {}

void Connections::shrink() {
  bool more = true;
  while (more) {
    const Dialect::Turn turn = dialect_->turn();
    more = read([this](soci::session& session) { return dialect_->shrink(session); });
  }
}

void Connections::run(const std::function<void(soci::session&)>& work) {
  Lease lease(pool_, timeout_);
  soci::session& session = lease.session();
  // A connection that lay idle while the database was away is found dead only when it is used: a second try then has
  // a new one.
  const auto last_try = std::chrono::steady_clock::now() + timeout_;
  for (bool was_open = session.get_backend() != nullptr;; was_open = false) {
    try {
      if (!session.get_backend()) open(session);
      const CallWatch::Call call(watch_, dialect_->socket(session));
      work(session);
      return;
    } catch (const soci::soci_error& error) {
      const Fault fault = dialect_->fault(error);
      if (fault == Fault::kDisconnected) session.close();
      const bool again = fault == Fault::kDisconnected && was_open && std::chrono::steady_clock::now() < last_try;
      if (!again) fail(fault, error);
    }
  }
}

void Connections::open(soci::session& session) const {
  try {
    dialect_->open(session);
  } catch (...) {
    session.close();  // or the next one would find it half set up
    throw;
  }
}

void Connections::fail(Fault fault, const soci::soci_error& error) const {
  std::string reason = error.get_error_message();
  std::ranges::replace(reason, '\n', ' ');
  const std::string what = fmt::format("the store's database ({}): {}", dialect_->description(), reason);
  switch (fault) {
    case Fault::kDisconnected:
      throw StoreUnavailable(what + "; try again later, and see whether the database runs and lets kcsd in");
    case Fault::kBusy:
      throw StoreUnavailable(what + "; try again later");
    case Fault::kFull:
      throw StoreFull(what + "; make room on its disk, and lower keep_bytes or keep_days in the settings");
    case Fault::kOther:
      break;
  }
  throw StoreError(
      what +
      "; trying again does not help: see whether it is the right database, undamaged, and whether kcsd may "
      "make tables in it");
}

Connections::Transaction::~Transaction() {
  if (committed_) return;
  try {
    session_.rollback();
  } catch (const soci::soci_error&) {
    // The database has done it already, or will when the connection goes.
  }
}

void Connections::Transaction::commit() {
  session_.commit();
  committed_ = true;
}

}  // namespace kcs::store
