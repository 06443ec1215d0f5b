// By its id a call is found again: in the client's hands, in its failure, in the server's log.
#include <gtest/gtest.h>

#include <string>

#include "tests/service/log_lines.h"
#include "tests/service/test_server.h"

namespace kcs::service::test {
namespace {

constexpr const char* kKey = "x-request-id";

std::string id_sent_back(const grpc::ClientContext& call) {
  const auto& metadata = call.GetServerTrailingMetadata();
  const auto found = metadata.find(kKey);
  return found == metadata.end() ? "" : std::string(found->second.data(), found->second.size());
}

class RequestId : public ::testing::Test {
 protected:
  // Asks for a plan that is not there.
  grpc::Status ask(Call& call) {
    v1::GetPlanRequest message;
    message.set_name("plans/none");
    v1::Plan plan;
    return server_.stub().GetPlan(&call, message, &plan);
  }

  LogLines lines_;
  TestServer server_{{.log = lines_.log()}};
};

TEST_F(RequestId, OfTheClientIsKept) {
  Call call;
  call.AddMetadata(kKey, "job-17/try:2");
  const grpc::Status status = ask(call);
  EXPECT_EQ(status.error_code(), grpc::StatusCode::NOT_FOUND);
  EXPECT_EQ(id_sent_back(call), "job-17/try:2");
  EXPECT_EQ(detail<google::rpc::RequestInfo>(status).request_id(), "job-17/try:2");
  const auto logged = lines_.with("request_id", "job-17/try:2");
  ASSERT_EQ(logged.size(), 1U);
  EXPECT_EQ(logged[0]["method"], "GetPlan");
  EXPECT_EQ(logged[0]["status"], "NOT_FOUND");
  EXPECT_EQ(logged[0]["plan"], "plans/none");
  EXPECT_EQ(logged[0]["level"], "info");
  EXPECT_GT(logged[0]["duration_s"], 0);
  EXPECT_TRUE(logged[0]["peer"].get<std::string>().starts_with("ipv4:127.0.0.1:"));
}

TEST_F(RequestId, IsNoAnswerYetSoThatGrpcTriesARefusedCallAgain) {
  Call call;
  ask(call);
  EXPECT_TRUE(call.GetServerInitialMetadata().empty());
}

TEST_F(RequestId, IsMadeUpWhereTheClientGivesNoneOrNonsense) {
  for (const std::string& given :
       {std::string(), std::string("two words"), std::string("a\"b"), std::string(129, 'x')}) {
    Call call;
    if (!given.empty()) call.AddMetadata(kKey, given);
    const grpc::Status status = ask(call);
    const std::string id = id_sent_back(call);
    EXPECT_EQ(id.size(), 32U) << id;
    EXPECT_EQ(id.find_first_not_of("0123456789abcdef"), std::string::npos) << id;
    EXPECT_EQ(detail<google::rpc::RequestInfo>(status).request_id(), id);
    EXPECT_EQ(lines_.with("request_id", id).size(), 1U);
  }
}

TEST_F(RequestId, DiffersFromCallToCall) {
  Call first;
  Call second;
  ask(first);
  ask(second);
  EXPECT_NE(id_sent_back(first), id_sent_back(second));
}

TEST_F(RequestId, IsInEveryLineOfACall) {
  Call call;
  call.AddMetadata(kKey, "mine");
  v1::Plan plan;
  const auto writer = server_.stub().CreatePlan(&call, &plan);
  writer->Write(request(options()));
  writer->Write(request(right_angle()));
  writer->WritesDone();
  ASSERT_TRUE(writer->Finish().ok());
  const auto logged = lines_.with("request_id", "mine");
  ASSERT_EQ(logged.size(), 2U);
  EXPECT_EQ(logged[0]["message"], "planned");
  EXPECT_EQ(logged[0]["segments"], 2);
  EXPECT_EQ(logged[1]["message"], "CreatePlan done");
  EXPECT_EQ(lines_.with("plan", plan.name()), logged);
}

TEST_F(RequestId, StandsBesideTheFieldViolations) {
  const auto refused = server_.create({request(options()), request(path({0, 0, 10, 0}, -1))});
  EXPECT_FALSE(violations(refused.status).empty());
  EXPECT_EQ(detail<google::rpc::RequestInfo>(refused.status).request_id().size(), 32U);
}

TEST_F(RequestId, OfAStreamComesWithItsEnd) {
  const std::string name = server_.create({request(options()), request(right_angle())}).message.name();
  Call call;
  call.AddMetadata(kKey, "stream");
  const auto reader = server_.stub().StreamSetpoints(&call, setpoints(name, 1e-3));
  v1::SetpointBatch batch;
  while (reader->Read(&batch)) continue;
  EXPECT_TRUE(reader->Finish().ok());
  EXPECT_EQ(id_sent_back(call), "stream");
}

TEST_F(RequestId, DoesNotBringLongOrUnprintableTextIntoTheLog) {
  Call call;
  call.AddMetadata(kKey, "long");
  v1::GetPlanRequest message;
  message.set_name(std::string(100'000, 'x') + "\n");
  v1::Plan plan;
  server_.stub().GetPlan(&call, message, &plan);
  const auto logged = lines_.with("request_id", "long");
  ASSERT_EQ(logged.size(), 1U);
  EXPECT_LT(logged[0].dump().size(), 1000U);
}

TEST(Retry, IsOfferedWhereItMayHelp) {
  TestServer server{{.caps = {.points_per_plan = 2, .uploads = 1}}};
  Call call;
  v1::Plan plan;
  const auto upload = server.stub().CreatePlan(&call, &plan);
  upload->Write(request(options()));
  grpc::Status full;
  ASSERT_TRUE(eventually([&] {
    full = server.create({request(options())}).status;
    return full.error_code() == grpc::StatusCode::RESOURCE_EXHAUSTED;
  }));
  EXPECT_EQ(detail<google::rpc::RetryInfo>(full).retry_delay().seconds(), 1);
  EXPECT_EQ(detail<google::rpc::RequestInfo>(full).request_id().size(), 32U);
  upload->Write(request(right_angle()));
  upload->WritesDone();
  const grpc::Status too_long = upload->Finish();
  EXPECT_EQ(too_long.error_code(), grpc::StatusCode::RESOURCE_EXHAUSTED);
  EXPECT_FALSE(detail<google::rpc::RetryInfo>(too_long).has_retry_delay());
}

}  // namespace
}  // namespace kcs::service::test
