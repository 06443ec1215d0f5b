// The calls of all services: who may make them, how they end, and how they are ended when the server stops.
#pragma once

#include <grpcpp/server_context.h>

#include <atomic>
#include <stop_token>
#include <string_view>

#include "server/service/access_control.h"
#include "server/service/call_record.h"
#include "server/service/caller.h"
#include "server/service/observation.h"
#include "server/service/status.h"

namespace kcs::service {

// Safe for use by many threads at once.
class Calls {
 public:
  // Keeps references to both.
  Calls(const AccessControl& access, const Observation& observation) : access_(access), observation_(observation) {}

  // Refuses calls from now on, but for those that see to machines in motion: these stay attached for a while, and must
  // be stopped here. Calls that run go on.
  void close() { closed_ = true; }
  bool closed() const { return closed_; }
  // Ends the calls that run, with UNAVAILABLE: those that wait, and streams when what they are sending is taken.
  void end() { end_.request_stop(); }
  // Asks to stop when the running calls are to end.
  std::stop_token ending() const { return end_.get_token(); }
  // Whether no call runs.
  bool idle() const { return running_ == 0; }

  // Runs `work` for a caller who may call this method. It takes the call's record and the Caller and returns a
  // grpc::Status; no exception gets out, as none may cross into gRPC. Counts and logs the call.
  template <typename Work>
  grpc::Status answer(std::string_view method, grpc::ServerContext& context, const Work& work);

  const Observation& observation() const { return observation_; }

 private:
  // Counts a call for as long as it runs.
  class Running {
   public:
    explicit Running(std::atomic<int>& count) : count_(count) { ++count_; }
    ~Running() { --count_; }
    Running(const Running&) = delete;
    Running& operator=(const Running&) = delete;

   private:
    std::atomic<int>& count_;
  };

  Caller admit(std::string_view method, const CallRecord& call, grpc::ServerContext& context) const;
  // Throws Cancelled once the client has gone, Stopping once the server ends its calls.
  void require_wanted(const grpc::ServerContext& context) const;

  const AccessControl& access_;
  const Observation& observation_;
  std::atomic<bool> closed_ = false;
  std::atomic<int> running_ = 0;
  std::stop_source end_;
};

template <typename Work>
grpc::Status Calls::answer(std::string_view method, grpc::ServerContext& context, const Work& work) {
  const Running running(running_);
  CallRecord call(observation_, method, context);
  CallEnd end;
  try {
    end.status = work(call, admit(method, call, context));
  } catch (...) {
    end = end_by_current_exception();
  }
  return call.finish(end);
}

}  // namespace kcs::service
