#include "tests/rpc/test_client.h"

#include <gtest/gtest.h>

#include <utility>

namespace kcs::test {
namespace {

// A request of one of the calls that only name a plan.
template <typename Request>
Request of_plan(const std::string& name) {
  Request request;
  request.set_name(name);
  return request;
}

template <typename Message>
Answer<std::vector<Message>> read_all(grpc::ClientReader<Message>& reader) {
  Answer<std::vector<Message>> answer;
  for (Message message; reader.Read(&message);) answer.message.push_back(message);
  answer.status = reader.Finish();
  return answer;
}

}  // namespace

std::shared_ptr<grpc::Channel> new_channel(const std::string& address,
                                           const std::shared_ptr<grpc::ChannelCredentials>& credentials) {
  grpc::ChannelArguments own;
  own.SetInt(GRPC_ARG_USE_LOCAL_SUBCHANNEL_POOL, 1);
  return grpc::CreateCustomChannel(address, credentials, own);
}

TestClient::TestClient(std::shared_ptr<grpc::Channel> channel, std::string token)
    : channel_(std::move(channel)), stub_(v1::PlanningService::NewStub(channel_)), token_(std::move(token)) {}

std::unique_ptr<Call> TestClient::call() const {
  auto call = std::make_unique<Call>();
  if (!token_.empty()) call->AddMetadata("authorization", "Bearer " + token_);
  return call;
}

Answer<v1::Plan> TestClient::create(const std::vector<v1::CreatePlanRequest>& messages) {
  Answer<v1::Plan> answer;
  const auto context = call();
  const auto writer = stub_->CreatePlan(context.get(), &answer.message);
  for (const v1::CreatePlanRequest& message : messages) {
    if (!writer->Write(message)) break;
  }
  writer->WritesDone();
  answer.status = writer->Finish();
  return answer;
}

Answer<v1::Plan> TestClient::get(const std::string& name) {
  Answer<v1::Plan> answer;
  answer.status = stub_->GetPlan(call().get(), of_plan<v1::GetPlanRequest>(name), &answer.message);
  return answer;
}

grpc::Status TestClient::remove(const std::string& name) {
  google::protobuf::Empty nothing;
  return stub_->DeletePlan(call().get(), of_plan<v1::DeletePlanRequest>(name), &nothing);
}

Answer<v1::ListPlansResponse> TestClient::list(const v1::ListPlansRequest& request) {
  Answer<v1::ListPlansResponse> answer;
  answer.status = stub_->ListPlans(call().get(), request, &answer.message);
  return answer;
}

Answer<std::vector<v1::Plan>> TestClient::list_all() {
  Answer<std::vector<v1::Plan>> answer;
  v1::ListPlansRequest request;
  do {
    const Answer<v1::ListPlansResponse> page = list(request);
    answer.status = page.status;
    answer.message.insert(answer.message.end(), page.message.plans().begin(), page.message.plans().end());
    request.set_page_token(page.message.next_page_token());
  } while (answer.status.ok() && !request.page_token().empty());
  return answer;
}

Answer<std::vector<v1::PlanProgress>> TestClient::watch(const std::string& name) {
  const auto context = call();
  return read_all(*stub_->WatchPlan(context.get(), of_plan<v1::WatchPlanRequest>(name)));
}

Answer<std::vector<v1::SetpointBatch>> TestClient::stream(const v1::StreamSetpointsRequest& request) {
  const auto context = call();
  return read_all(*stub_->StreamSetpoints(context.get(), request));
}

Answer<std::vector<v1::Corner>> TestClient::corners(const std::string& name) {
  const auto context = call();
  const auto batches = read_all(*stub_->DescribeCorners(context.get(), of_plan<v1::DescribeCornersRequest>(name)));
  Answer<std::vector<v1::Corner>> answer{.status = batches.status, .message = {}};
  for (const v1::CornerBatch& batch : batches.message) {
    answer.message.insert(answer.message.end(), batch.corners().begin(), batch.corners().end());
  }
  return answer;
}

v1::Plan TestClient::wait_until_ready(const std::string& name) {
  Answer<v1::Plan> answer;
  EXPECT_TRUE(eventually([&] {
    answer = get(name);
    return !answer.status.ok() || answer.message.state() == v1::PLAN_STATE_READY;
  })) << name
      << " is not planned";
  EXPECT_TRUE(answer.status.ok()) << answer.status.error_message();
  return answer.message;
}

std::string content(const v1::Plan& plan) {
  v1::Plan copy = plan;
  copy.clear_state();
  copy.clear_create_time();
  return copy.SerializeAsString();
}

std::vector<std::string> bytes(const std::vector<v1::SetpointBatch>& batches) {
  std::vector<std::string> list;
  for (const v1::SetpointBatch& batch : batches) list.push_back(batch.SerializeAsString());
  return list;
}

}  // namespace kcs::test
