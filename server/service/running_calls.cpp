#include "server/service/running_calls.h"

#include <kcs/v1/planning.grpc.pb.h>

#include <string>
#include <string_view>

namespace kcs::service {
namespace {

using grpc::experimental::InterceptorBatchMethods;

// One call: gRPC destroys its interceptors when it is over.
class CountedCall final : public grpc::experimental::Interceptor {
 public:
  explicit CountedCall(std::atomic<std::int64_t>& count) : count_(count) { ++count_; }
  ~CountedCall() override { --count_; }
  CountedCall(const CountedCall&) = delete;
  CountedCall& operator=(const CountedCall&) = delete;

  void Intercept(InterceptorBatchMethods* methods) override { methods->Proceed(); }

 private:
  std::atomic<std::int64_t>& count_;
};

class Counter final : public grpc::experimental::ServerInterceptorFactoryInterface {
 public:
  explicit Counter(std::atomic<std::int64_t>& count) : count_(count) {}

  grpc::experimental::Interceptor* CreateServerInterceptor(grpc::experimental::ServerRpcInfo* call) override {
    const std::string planning = "/" + std::string(v1::PlanningService::service_full_name()) + "/";
    // gRPC takes the ownership; no interceptor where there is null.
    if (!std::string_view(call->method()).starts_with(planning)) return nullptr;
    return std::make_unique<CountedCall>(count_).release();
  }

 private:
  std::atomic<std::int64_t>& count_;
};

}  // namespace

std::unique_ptr<grpc::experimental::ServerInterceptorFactoryInterface> RunningCalls::counter() {
  return std::make_unique<Counter>(count_);
}

}  // namespace kcs::service
