#include "tests/service/test_server.h"

#include <grpc/grpc.h>

#include <utility>

namespace kcs::service::test {
namespace {

ServerOptions on_loopback(ServerOptions options) {
  // gRPC ends with its last object, and now and then takes ten seconds for it: this keeps it for the next test.
  static const bool kept = (grpc_init(), true);
  EXPECT_TRUE(kept);
  options.listen = "127.0.0.1:0";
  if (options.store.database == store::StoreSettings().database) options.store.database = "memory";
  return options;
}

}  // namespace

LoopbackServer::LoopbackServer(ServerOptions options)
    : server_(std::make_unique<Server>(on_loopback(std::move(options)))) {}

TestServer::TestServer(ServerOptions options)
    : LoopbackServer(std::move(options)), TestClient(new_channel(address())) {}

std::vector<double> column(const std::vector<v1::SetpointBatch>& batches, int axis,
                           const google::protobuf::RepeatedPtrField<v1::Column>& (v1::SetpointBatch::*channel)()
                               const) {
  std::vector<double> numbers;
  for (const v1::SetpointBatch& batch : batches) {
    const auto& values = (batch.*channel)().Get(axis).values();
    numbers.insert(numbers.end(), values.begin(), values.end());
  }
  return numbers;
}

}  // namespace kcs::service::test
