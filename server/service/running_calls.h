// Counts the planning calls that are under way, from their first byte until their answer has gone out.
#pragma once

#include <grpcpp/support/server_interceptor.h>

#include <atomic>
#include <cstdint>
#include <memory>

namespace kcs::service {

// Every call of PlanningService is counted; health and reflection are not, as a watcher of them stays for ever.
// The server's builder takes a counter() and keeps it; this object must outlive the server.
class RunningCalls {
 public:
  std::unique_ptr<grpc::experimental::ServerInterceptorFactoryInterface> counter();

  bool none() const { return count_ == 0; }

 private:
  std::atomic<std::int64_t> count_ = 0;
};

}  // namespace kcs::service
