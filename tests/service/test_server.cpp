#include "tests/service/test_server.h"

#include <grpc/grpc.h>

#include <thread>
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

TestServer::TestServer(ServerOptions options)
    : server_(std::make_unique<Server>(on_loopback(std::move(options)))),
      stub_(v1::PlanningService::NewStub(new_channel())) {}

std::shared_ptr<grpc::Channel> TestServer::new_channel() const {
  grpc::ChannelArguments arguments;
  arguments.SetInt(GRPC_ARG_USE_LOCAL_SUBCHANNEL_POOL, 1);
  return grpc::CreateCustomChannel(server_->address(), grpc::InsecureChannelCredentials(), arguments);
}

Answer<v1::Plan> TestServer::create(const std::vector<v1::CreatePlanRequest>& messages) {
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

Answer<v1::Plan> TestServer::get(const std::string& name) {
  Answer<v1::Plan> answer;
  Call call;
  v1::GetPlanRequest message;
  message.set_name(name);
  answer.status = stub_->GetPlan(&call, message, &answer.message);
  return answer;
}

grpc::Status TestServer::remove(const std::string& name) {
  Call call;
  v1::DeletePlanRequest message;
  message.set_name(name);
  google::protobuf::Empty nothing;
  return stub_->DeletePlan(&call, message, &nothing);
}

Answer<std::vector<v1::SetpointBatch>> TestServer::stream(const v1::StreamSetpointsRequest& message) {
  Answer<std::vector<v1::SetpointBatch>> answer;
  Call call;
  const auto reader = stub_->StreamSetpoints(&call, message);
  for (v1::SetpointBatch batch; reader->Read(&batch);) answer.message.push_back(batch);
  answer.status = reader->Finish();
  return answer;
}

Answer<std::vector<v1::Corner>> TestServer::corners(const std::string& name) {
  Answer<std::vector<v1::Corner>> answer;
  Call call;
  v1::DescribeCornersRequest message;
  message.set_name(name);
  const auto reader = stub_->DescribeCorners(&call, message);
  for (v1::CornerBatch batch; reader->Read(&batch);) {
    answer.message.insert(answer.message.end(), batch.corners().begin(), batch.corners().end());
  }
  answer.status = reader->Finish();
  return answer;
}

v1::PlanOptions options(std::uint32_t axes) {
  v1::PlanOptions options;
  options.mutable_machine()->set_axes(axes);
  for (std::uint32_t axis = 0; axis < axes; ++axis) {
    options.mutable_machine()->add_velocity_mm_s(100);
    options.mutable_machine()->add_acceleration_mm_s2(2500);
    options.mutable_machine()->add_jerk_mm_s3(2e5);
  }
  return options;
}

v1::CreatePlanRequest request(const v1::PlanOptions& options) {
  v1::CreatePlanRequest message;
  *message.mutable_options() = options;
  return message;
}

v1::CreatePlanRequest request(const v1::PathChunk& path) {
  v1::CreatePlanRequest message;
  *message.mutable_path() = path;
  return message;
}

v1::CreatePlanRequest gcode(std::string_view text) {
  v1::CreatePlanRequest message;
  message.set_gcode(std::string(text));
  return message;
}

v1::PathChunk path(const std::vector<double>& points, double feed) {
  v1::PathChunk chunk;
  chunk.mutable_points_mm()->Add(points.begin(), points.end());
  chunk.add_feed_mm_s(feed);
  return chunk;
}

v1::PathChunk right_angle() { return path({0, 0, 10, 0, 10, 10}); }

v1::StreamSetpointsRequest setpoints(const std::string& name, double period) {
  v1::StreamSetpointsRequest message;
  message.set_name(name);
  message.set_period_s(period);
  return message;
}

std::string content(const v1::Plan& plan) {
  v1::Plan copy = plan;
  copy.clear_state();
  copy.clear_create_time();
  return copy.SerializeAsString();
}

std::vector<std::string> violations(const grpc::Status& status) {
  std::vector<std::string> list;
  const auto refused = detail<google::rpc::BadRequest>(status);
  for (const auto& violation : refused.field_violations()) {
    list.push_back(violation.field() + ": " + violation.description());
  }
  return list;
}

::testing::AssertionResult refuses_field(const grpc::Status& status, const std::string& field) {
  if (status.error_code() != grpc::StatusCode::INVALID_ARGUMENT) {
    return ::testing::AssertionFailure() << "status " << status.error_code() << ": " << status.error_message();
  }
  auto failure = ::testing::AssertionFailure() << "no violation of \"" << field << "\" among:";
  for (const std::string& violation : violations(status)) {
    if (violation.starts_with(field + ": ") && violation.size() > field.size() + 2) {
      return ::testing::AssertionSuccess();
    }
    failure << "\n  " << violation;
  }
  return failure;
}

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

bool eventually(const std::function<bool()>& condition) {
  const auto end = std::chrono::steady_clock::now() + kDeadline;
  while (!condition()) {
    if (std::chrono::steady_clock::now() > end) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  return true;
}

}  // namespace kcs::service::test
