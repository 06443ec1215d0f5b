// The connections to the database: lends them, opens them again when they break, and tells what went wrong.
#pragma once

#include <soci/soci.h>

#include <chrono>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <type_traits>

#include "server/store/call_watch.h"
#include "server/store/dialect.h"
#include "server/store/settings.h"

namespace kcs::store {

// Safe for use by many threads at once. Work that is handed in may run a second time, when the first connection turns
// out to have died: it must only change the database and what it makes itself. Throws the exceptions of errors.h in
// place of SOCI's.
class Connections {
 public:
  // Connects nothing yet. Throws StoreError if the settings name no database.
  explicit Connections(const StoreSettings& settings);

  const Dialect& dialect() const { return *dialect_; }

  // Returns what work(session) returns; each of its statements is a transaction of its own.
  template <typename Work>
  auto read(const Work& work) {
    std::optional<std::invoke_result_t<Work, soci::session&>> result;
    run([&](soci::session& session) { result = work(session); });
    return *std::move(result);
  }

  // The same in one transaction, in which no other one on the same subject comes between.
  template <typename Work>
  auto write(const std::string& subject, const Work& work) {
    const Dialect::Turn turn = dialect_->turn();  // before a connection: those are for who can go on
    return read([&](soci::session& session) {
      Transaction transaction(session);
      dialect_->begin(session, subject);
      auto result = work(session);
      transaction.commit();
      return result;
    });
  }

  // Gives room that became free back to the disk, in steps, so that nobody has to wait for long.
  void shrink();

 private:
  // A transaction that ends without effect unless it is committed.
  class Transaction {
   public:
    explicit Transaction(soci::session& session) : session_(session) {}
    ~Transaction();
    Transaction(const Transaction&) = delete;
    Transaction& operator=(const Transaction&) = delete;
    void commit();

   private:
    soci::session& session_;
    bool committed_ = false;
  };

  void run(const std::function<void(soci::session&)>& work);
  void open(soci::session& session) const;
  [[noreturn]] void fail(Fault fault, const soci::soci_error& error) const;

  const std::unique_ptr<const Dialect> dialect_;
  const std::chrono::milliseconds timeout_;
  soci::connection_pool pool_;
  CallWatch watch_;
};

}  // namespace kcs::store
