#include "tests/system/test_kcsd.h"

#include <grpcpp/generic/generic_stub.h>
#include <httplib.h>

#include <cmath>
#include <fstream>
#include <stdexcept>
#include <thread>
#include <utility>

namespace kcs::test {
namespace {

constexpr std::string_view kGreeting = "kcsd listens on ";
constexpr std::string_view kFigures = "figures on http://";

std::string address_of(ChildProcess& kcsd) {
  const std::string greeting = kcsd.read_line();
  if (!greeting.starts_with(kGreeting)) throw std::runtime_error("kcsd said \"" + greeting + "\": " + kcsd.errors());
  return greeting.substr(kGreeting.size());
}

std::string http_address_of(const ChildProcess& kcsd) {
  std::string address;
  eventually([&] {
    const std::string log = kcsd.errors();
    const std::size_t begin = log.find(kFigures);
    const std::size_t end = begin == std::string::npos ? begin : log.find("/metrics", begin);
    if (end == std::string::npos) return false;
    address = log.substr(begin + kFigures.size(), end - begin - kFigures.size());
    return true;
  });
  return address;
}

}  // namespace

TestKcsd::TestKcsd(const std::string& settings)
    : process_({KCSD, "--config", config(settings), "--listen", "127.0.0.1:0", "--http-listen", "127.0.0.1:0"}),
      address_(address_of(process_)),
      http_address_(http_address_of(process_)),
      stub_(new_stub()) {}

std::unique_ptr<v1::PlanningService::Stub> TestKcsd::new_stub() const {
  grpc::ChannelArguments own;
  own.SetInt(GRPC_ARG_USE_LOCAL_SUBCHANNEL_POOL, 1);
  return v1::PlanningService::NewStub(grpc::CreateCustomChannel(address_, grpc::InsecureChannelCredentials(), own));
}

Answer<v1::Plan> TestKcsd::create(const std::vector<v1::CreatePlanRequest>& messages) {
  Answer<v1::Plan> answer;
  Call call;
  const auto writer = stub_->CreatePlan(&call, &answer.message);
  for (const v1::CreatePlanRequest& message : messages) {
    if (!writer->Write(message)) break;
  }
  writer->WritesDone();
  answer.status = writer->Finish();
  return answer;
}

Answer<v1::Plan> TestKcsd::get(const std::string& name) {
  Answer<v1::Plan> answer;
  Call call;
  v1::GetPlanRequest request;
  request.set_name(name);
  answer.status = stub_->GetPlan(&call, request, &answer.message);
  return answer;
}

grpc::Status TestKcsd::remove(const std::string& name) {
  Call call;
  v1::DeletePlanRequest request;
  request.set_name(name);
  google::protobuf::Empty nothing;
  return stub_->DeletePlan(&call, request, &nothing);
}

Answer<std::vector<v1::Plan>> TestKcsd::list() {
  Answer<std::vector<v1::Plan>> answer;
  v1::ListPlansRequest request;
  do {
    Call call;
    v1::ListPlansResponse page;
    answer.status = stub_->ListPlans(&call, request, &page);
    answer.message.insert(answer.message.end(), page.plans().begin(), page.plans().end());
    request.set_page_token(page.next_page_token());
  } while (answer.status.ok() && !request.page_token().empty());
  return answer;
}

Answer<std::vector<std::string>> TestKcsd::stream(const v1::StreamSetpointsRequest& request) {
  Answer<std::vector<std::string>> answer;
  Call call;
  const auto reader = stub_->StreamSetpoints(&call, request);
  for (v1::SetpointBatch batch; reader->Read(&batch);) answer.message.push_back(batch.SerializeAsString());
  answer.status = reader->Finish();
  return answer;
}

v1::Plan TestKcsd::wait_until_ready(const std::string& name) {
  Answer<v1::Plan> answer;
  EXPECT_TRUE(eventually([&] {
    answer = get(name);
    return !answer.status.ok() || answer.message.state() == v1::PLAN_STATE_READY;
  })) << name
      << " is not planned";
  EXPECT_TRUE(answer.status.ok()) << answer.status.error_message();
  return answer.message;
}

TestKcsd::Page TestKcsd::page(const std::string& path) const {
  httplib::Client client("http://" + http_address_);
  client.set_read_timeout(kDeadline);
  const auto answer = client.Get(path);
  return answer ? Page{answer->status, answer->body} : Page{};
}

// By hand: the messages of grpc.health.v1 are in no package, and two fields make them.
std::optional<bool> TestKcsd::is_serving(const std::string& service) const {
  grpc::GenericStub stub(grpc::CreateChannel(address_, grpc::InsecureChannelCredentials()));
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

std::size_t TestKcsd::status_figure(const std::string& word) const {
  std::ifstream file("/proc/" + std::to_string(process_.pid()) + "/status");
  for (std::string found; file >> found;) {
    std::size_t number = 0;
    if (found == word && file >> number) return number;
  }
  ADD_FAILURE() << "kcsd is gone: " << process_.errors();
  return 0;
}

std::string TestKcsd::config(const std::string& settings) const {
  const auto file = folder_.path() / "kcsd.toml";
  std::ofstream(file) << settings;
  return file;
}

v1::PlanOptions mill() {
  v1::PlanOptions options;
  options.mutable_machine()->set_axes(3);
  for (int axis = 0; axis < 3; ++axis) {
    options.mutable_machine()->add_velocity_mm_s(100);
    options.mutable_machine()->add_acceleration_mm_s2(2500);
    options.mutable_machine()->add_jerk_mm_s3(2e5);
  }
  return options;
}

std::vector<v1::CreatePlanRequest> request_of(std::uint64_t number, int moves) {
  std::vector<v1::CreatePlanRequest> messages(2);
  *messages[0].mutable_options() = mill();
  v1::PathChunk& path = *messages[1].mutable_path();
  path.add_feed_mm_s(50);
  double x = 0, y = 0;
  for (int move = 0; move <= moves; ++move) {
    for (const double number_of_axis : {x, y, 0.001 * static_cast<double>(number)}) path.add_points_mm(number_of_axis);
    x += 10 * std::cos(move * move);
    y += 10 * std::sin(move * move);
  }
  return messages;
}

std::vector<v1::CreatePlanRequest> accept_only(std::vector<v1::CreatePlanRequest> messages) {
  messages.front().set_accept_only(true);
  return messages;
}

v1::StreamSetpointsRequest setpoints(const std::string& name, double period) {
  v1::StreamSetpointsRequest request;
  request.set_name(name);
  request.set_period_s(period);
  return request;
}

std::string content(const v1::Plan& plan) {
  v1::Plan copy = plan;
  copy.clear_create_time();
  return copy.SerializeAsString();
}

::testing::AssertionResult tells_when_to_try_again(const grpc::Status& status) {
  google::rpc::Status details;
  details.ParseFromString(status.error_details());
  for (const google::protobuf::Any& detail : details.details()) {
    if (detail.Is<google::rpc::RetryInfo>()) return ::testing::AssertionSuccess();
  }
  return ::testing::AssertionFailure() << "no RetryInfo: " << status.error_code() << " " << status.error_message();
}

::testing::AssertionResult is_unavailable_for_a_while(const grpc::Status& status) {
  if (status.error_code() == grpc::StatusCode::UNAVAILABLE) return tells_when_to_try_again(status);
  return ::testing::AssertionFailure() << "status " << status.error_code() << " " << status.error_message();
}

bool eventually(const std::function<bool()>& condition) {
  const auto end = std::chrono::steady_clock::now() + kDeadline;
  while (!condition()) {
    if (std::chrono::steady_clock::now() > end) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  return true;
}

}  // namespace kcs::test
