// Notices that a client has gone, while its call is busy.
#pragma once

#include <grpcpp/server_context.h>

#include <condition_variable>
#include <mutex>
#include <set>
#include <stop_token>
#include <thread>

namespace kcs::service {

// A synchronous call hears that it was cancelled, or that its deadline passed, only where it reads or writes; planning
// does neither for as long as seconds. This asks for all calls under way, a hundred times a second. Safe for use by
// many threads at once.
class CancelWatch {
 public:
  CancelWatch();
  CancelWatch(const CancelWatch&) = delete;
  CancelWatch& operator=(const CancelWatch&) = delete;

  // A call that is watched, for as long as this lives. The watch and the context outlive it.
  class Call {
   public:
    Call(CancelWatch& watch, const grpc::ServerContext& context);
    ~Call();
    Call(const Call&) = delete;
    Call& operator=(const Call&) = delete;

    // Asks to stop once the client has gone.
    std::stop_token stop() const { return stop_.get_token(); }

   private:
    friend class CancelWatch;

    CancelWatch& watch_;
    const grpc::ServerContext& context_;
    std::stop_source stop_;
  };

 private:
  void work(const std::stop_token& stopping);

  std::mutex mutex_;
  std::condition_variable_any changed_;
  std::set<Call*> calls_;
  std::jthread thread_;  // last, so that it is gone before what it uses
};

}  // namespace kcs::service
