#include "tests/system/test_kcsd.h"

#include <grpcpp/generic/generic_stub.h>
#include <httplib.h>

#include <cmath>

namespace kcs::test {

TestKcsd::TestKcsd(const std::string& settings) : TestKcsd(ConfigFile(settings)) {}

TestKcsd::TestKcsd(const ConfigFile& config)
    : KcsdProcess({KCSD, "--config", config.path(), "--listen", "127.0.0.1:0", "--http-listen", "127.0.0.1:0"}),
      TestClient(new_channel(address())),
      http_address_(http_address_of(process())) {}

TestKcsd::Page TestKcsd::page(const std::string& path) const {
  httplib::Client client("http://" + http_address_);
  client.set_read_timeout(kDeadline);
  const auto answer = client.Get(path);
  return answer ? Page{answer->status, answer->body} : Page{};
}

// By hand: the messages of grpc.health.v1 are in no package, and two fields make them.
std::optional<bool> TestKcsd::is_serving(const std::string& service) const {
  grpc::GenericStub stub(grpc::CreateChannel(address(), grpc::InsecureChannelCredentials()));
  std::string bytes;
  if (!service.empty()) bytes = "\x0a" + std::string(1, static_cast<char>(service.size())) + service;
  const grpc::Slice slice(bytes);
  const grpc::ByteBuffer request(&slice, 1);
  grpc::ByteBuffer response;
  Call call;
  grpc::CompletionQueue queue;
  const auto reader = stub.PrepareUnaryCall(&call, "/grpc.health.v1.Health/Check", request, &queue);
  reader->StartCall();
  grpc::Status status;
  reader->Finish(&response, &status, nullptr);
  void* tag = nullptr;
  bool ok = false;
  queue.Next(&tag, &ok);
  if (!status.ok()) return {};
  std::vector<grpc::Slice> slices;
  response.Dump(&slices);
  std::string answer;
  for (const grpc::Slice& part : slices) answer.append(reinterpret_cast<const char*>(part.begin()), part.size());
  return answer == "\x08\x01";
}

std::vector<v1::CreatePlanRequest> request_of(std::uint64_t number, int moves) {
  std::vector<v1::CreatePlanRequest> messages(2);
  *messages[0].mutable_options() = options(3);
  v1::PathChunk& path = *messages[1].mutable_path();
  path.add_feed_mm_s(50);
  double x = 0, y = 0;
  for (int move = 0; move <= moves; ++move) {
    for (const double number_of_axis : {x, y, 0.001 * static_cast<double>(number)}) path.add_points_mm(number_of_axis);
    path.add_line(static_cast<std::uint32_t>(1 + move / 2));
    x += 10 * std::cos(move * move);
    y += 10 * std::sin(move * move);
  }
  return messages;
}

std::vector<v1::CreatePlanRequest> accept_only(std::vector<v1::CreatePlanRequest> messages) {
  messages.front().set_accept_only(true);
  return messages;
}

}  // namespace kcs::test
