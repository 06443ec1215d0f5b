// One call, as the log, the figures and its client know it.
#pragma once

#include <grpcpp/server_context.h>
#include <grpcpp/support/status.h>

#include <chrono>
#include <string>
#include <string_view>

#include "server/observe/gauge.h"
#include "server/service/observation.h"
#include "server/service/status.h"

namespace kcs::service {

// Made when a call begins; counts it as running until it dies. Sends the call's id to the client.
class CallRecord {
 public:
  // method: without its service. Keeps references to `observation` and `context`.
  CallRecord(const Observation& observation, std::string_view method, grpc::ServerContext& context);
  CallRecord(const CallRecord&) = delete;
  CallRecord& operator=(const CallRecord&) = delete;

  const std::string& request_id() const { return request_id_; }

  // A field of the call's line in the log, beside its id, method, peer, status and duration: no secrets. May come from
  // the client: it is cut and made printable.
  void note(const std::string& field, std::string_view text);

  // The call ends: counts it, logs it in one line, and gives what the client is to be answered, which is `end` with
  // the call's id in it if it is a failure. To be called once.
  grpc::Status finish(const CallEnd& end);

 private:
  void count(const CallEnd& end) const;
  void log(const CallEnd& end) const;

  const Observation& observation_;
  const std::string method_;
  const grpc::ServerContext& context_;
  const std::string request_id_;
  const observe::Gauge::Share running_;
  const std::chrono::steady_clock::time_point began_ = std::chrono::steady_clock::now();
  observe::LogFields notes_ = observe::LogFields::object();
};

}  // namespace kcs::service
