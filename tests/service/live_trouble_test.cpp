// PlanLive with bad paths, clients that are slow or give up, at the caps, and with a server that stops.
#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <string>
#include <thread>
#include <vector>

#include "tests/service/live_client.h"

namespace kcs::service::test {
namespace {

using Messages = std::vector<v1::CreatePlanRequest>;

// A zigzag from point `first` on.
v1::PathChunk zigzag(int first, int count) {
  std::vector<double> numbers;
  for (int i = first; i < first + count; ++i) numbers.insert(numbers.end(), {i * 2.0, i % 2 * 3.0});
  return path(numbers);
}

class LiveTrouble : public ::testing::Test {
 protected:
  LiveAnswer exchange(const std::vector<v1::PlanLiveRequest>& messages) {
    return LiveClient(server_).exchange(messages);
  }
  LiveAnswer exchange(const Messages& messages) { return exchange(live(messages, every(0.001))); }

  ::testing::AssertionResult serves() {
    return exchange({request(options()), request(right_angle())}).plans.size() == 1U ? ::testing::AssertionSuccess()
                                                                                     : ::testing::AssertionFailure();
  }

  TestServer server_{{.caps = {.points_per_plan = 50,
                               .gcode_bytes = 1000,
                               .message_bytes = 100'000,
                               .live_streams = 1,
                               .look_ahead = 1000}}};
};

TEST_F(LiveTrouble, BadPointsAreNamedByTheirPlaceInTheWholePath) {
  v1::PathChunk bad = zigzag(900, 10);
  bad.mutable_feed_mm_s()->Resize(10, 100);
  bad.set_feed_mm_s(4, -1);
  const LiveAnswer answer =
      exchange({request(options()), request(zigzag(0, 500)), request(zigzag(500, 400)), request(bad)});
  EXPECT_TRUE(refuses_field(answer.status, "path.feed_mm_s, segment 903"));
  EXPECT_TRUE(answer.plans.empty());
  EXPECT_FALSE(answer.setpoints.empty()) << "what was settled before has come";
  EXPECT_TRUE(eventually([this] { return bool(serves()); }));
}

// However long a line is, nothing of it can be settled before its end is known.
TEST_F(LiveTrouble, LineWithoutEndIsRefusedBeforeItFillsTheMemory) {
  std::vector<v1::CreatePlanRequest> line = {request(options())};
  for (int chunk = 0; chunk < 3; ++chunk) {
    v1::PathChunk points;
    points.add_feed_mm_s(100);
    for (int i = 0; i < 500; ++i) {
      points.add_points_mm(0.01 * (500 * chunk + i));
      points.add_points_mm(0);
    }
    line.push_back(request(points));
  }
  const LiveAnswer answer = exchange(line);
  EXPECT_EQ(answer.status.error_code(), grpc::StatusCode::RESOURCE_EXHAUSTED);
  EXPECT_NE(answer.status.error_message().find("look_ahead = 1000"), std::string::npos)
      << answer.status.error_message();
  EXPECT_TRUE(eventually([this] { return bool(serves()); }));
}

TEST_F(LiveTrouble, BadGcodeIsNamedByLineAndColumn) {
  std::string program = "G1 F600\n";
  for (int i = 1; i < 40; ++i) program += "X" + std::to_string(i) + " Y" + std::to_string(i % 2) + "\n";
  const LiveAnswer answer = exchange({request(options()), gcode(program), gcode("G1 X#<nothing>\n")});
  EXPECT_TRUE(refuses_field(answer.status, "gcode, line 41, column 5")) << answer.status.error_message();
}

TEST_F(LiveTrouble, RequestsThatAreNone) {
  const auto refused = [this](const std::vector<v1::PlanLiveRequest>& messages, const std::string& field) {
    EXPECT_TRUE(refuses_field(exchange(messages).status, field));
  };
  const Messages good = {request(options()), request(right_angle())};
  refused({}, "options");
  refused(live({request(right_angle())}, every(1)), "options");
  refused(live({request(options()), request(options())}, every(1)), "options");
  refused(live({request(options())}, every(1)), "path");
  refused(live({request(options()), gcode("M30\n")}, every(1)), "path");
  refused(live({request(options()), request(right_angle()), gcode("G0 X1\n")}, every(1)), "gcode");
  refused(live({request(options()), v1::CreatePlanRequest()}, every(1)), "content");
  refused(live(good, {}), "output.period_s");
  for (const double period : {0.0, -1.0, 9e-6, 11.0, double(NAN), double(INFINITY)}) {
    refused(live(good, every(period)), "output.period_s");
  }
  v1::LiveOutput output = every(1);
  output.set_batch_size(0);
  refused(live(good, output), "output.batch_size");
  output = every(1);
  output.add_channels(v1::CHANNEL_UNSPECIFIED);
  refused(live(good, output), "output.channels[0]");
  auto twice = live(good, every(1));
  *twice.back().mutable_output() = every(1);
  refused(twice, "output");
  EXPECT_TRUE(serves());
}

TEST_F(LiveTrouble, MessageThatCannotBeParsedIsNotTakenForTheEnd) {
  Call call;
  grpc::internal::RpcMethod method("/kcs.v1.PlanningService/PlanLive", grpc::internal::RpcMethod::BIDI_STREAMING);
  using Stream = grpc::ClientReaderWriter<grpc::ByteBuffer, v1::PlanLiveResponse>;
  const auto channel = new_channel(server_.address());
  const std::unique_ptr<Stream> stream(
      grpc::internal::ClientReaderWriterFactory<grpc::ByteBuffer, v1::PlanLiveResponse>::Create(channel.get(), method,
                                                                                                &call));
  for (const auto& message : live({request(options()), request(right_angle())}, every(1))) {
    const grpc::Slice slice(message.SerializeAsString());
    stream->Write(grpc::ByteBuffer(&slice, 1));
  }
  const grpc::Slice slice("\xff\xff\xff");
  stream->Write(grpc::ByteBuffer(&slice, 1));
  stream->WritesDone();
  for (v1::PlanLiveResponse response; stream->Read(&response);) EXPECT_FALSE(response.has_plan());
  EXPECT_TRUE(refuses_field(stream->Finish(), "content"));
}

TEST_F(LiveTrouble, PathMayBeLongerThanAStoredOne) {
  EXPECT_EQ(exchange({request(options()), request(zigzag(0, 400))}).plans.size(), 1U);
  const std::string comment = "(" + std::string(598, 'x') + ")\n";
  EXPECT_EQ(exchange({request(options()), gcode("G1 F600 X1\n"), gcode(comment), gcode(comment)}).plans.size(), 1U);
  const grpc::Status arc = exchange({request(options()), gcode("G64 P0.0001\nG2 X0 Y0 I1000 F600\n")}).status;
  EXPECT_EQ(arc.error_code(), grpc::StatusCode::RESOURCE_EXHAUSTED);
  EXPECT_NE(arc.error_message().find("points_per_plan = 50"), std::string::npos) << arc.error_message();
}

// The points before it would make a path by themselves.
TEST_F(LiveTrouble, MessageThatIsTooLargeIsNotTakenForTheEnd) {
  const LiveAnswer answer = exchange({request(options()), request(zigzag(0, 300)), request(zigzag(300, 10'000))});
  EXPECT_EQ(answer.status.error_code(), grpc::StatusCode::RESOURCE_EXHAUSTED) << answer.status.error_message();
  EXPECT_TRUE(answer.plans.empty());
}

TEST_F(LiveTrouble, OnlySoManyAtTheSameTime) {
  LiveClient first(server_);
  for (const auto& message : live({request(options()), request(zigzag(0, 1000))}, every(0.01)))
    ASSERT_TRUE(first.write(message));
  v1::PlanLiveResponse response;
  ASSERT_TRUE(first.read(response)) << "it must have begun before the others come";
  const grpc::Status status = exchange(live({request(options()), request(right_angle())}, every(1))).status;
  EXPECT_EQ(status.error_code(), grpc::StatusCode::RESOURCE_EXHAUSTED);
  EXPECT_NE(status.error_message().find("live_streams = 1"), std::string::npos) << status.error_message();
  first.end_path();
  EXPECT_TRUE(first.read_all().status.ok());
  EXPECT_TRUE(eventually([this] { return bool(serves()); }));
}

TEST_F(LiveTrouble, CallsThatAreCancelledLeaveNothingBehind) {
  for (int round = 0; round < 10; ++round) {
    LiveClient client(server_);
    client.write(live({request(options())}, every(1e-5))[0]);
    v1::PlanLiveResponse response;
    for (int i = 0; i < round; ++i) {
      for (const auto& message : live({request(zigzag(300 * i, 300))}, every(1))) {
        v1::PlanLiveRequest piece = message;
        piece.clear_output();
        client.write(piece);
      }
    }
    if (round > 5) {
      EXPECT_TRUE(client.read(response));
    }
    client.cancel();
    EXPECT_FALSE(client.read_all().status.ok());
    EXPECT_TRUE(eventually([this] { return bool(serves()); }));
  }
}

// A move takes thirty thousand bytes, and its setpoints ninety thousand. What the connection takes in before it holds
// up the sender is some ten million.
TEST(LivePressure, SetpointsThatNobodyTakesHoldUpThePath) {
  TestServer server;
  constexpr int kMoves = 1'500;
  v1::LiveOutput output = every(1e-4);
  for (const v1::Channel channel : {v1::CHANNEL_VELOCITY, v1::CHANNEL_ACCELERATION, v1::CHANNEL_JERK}) {
    output.add_channels(channel);
  }
  LiveClient client(server);
  std::atomic<int> sent = 0;
  std::jthread writer([&] {
    EXPECT_TRUE(client.write(live({request(options())}, output)[0]));
    std::string comments;
    for (int i = 0; i < 10; ++i) comments += "(" + std::string(3000, 'x') + ")\n";
    v1::PlanLiveRequest message;
    for (int i = 1; i <= kMoves; ++i) {
      message.set_gcode(comments + "G1 F6000 X" + std::to_string(10 * i) + " Y" + std::to_string(i % 2) + "\n");
      EXPECT_TRUE(client.write(message));
      sent = i;
    }
    client.end_path();
  });
  int before = -1;
  EXPECT_TRUE(eventually([&] {
    std::this_thread::sleep_for(std::chrono::seconds(1));
    const int last = std::exchange(before, sent.load());
    return last == before;
  }));
  EXPECT_LT(sent, kMoves / 2) << "the server takes the path though nobody takes its setpoints";
  const LiveAnswer answer = client.read_all();
  EXPECT_TRUE(answer.status.ok()) << answer.status.error_message();
  ASSERT_EQ(answer.plans.size(), 1U);
  EXPECT_EQ(answer.plans[0].summary().segment_count(), kMoves);
  EXPECT_TRUE(answer.setpoints.back().end_of_path());
}

TEST(LiveStop, LetsARunningCallFinish) {
  TestServer server;
  LiveClient client(server);
  const auto messages = live({request(options()), request(zigzag(0, 1000))}, every(0.001));
  for (const auto& message : messages) ASSERT_TRUE(client.write(message));
  v1::PlanLiveResponse response;
  ASSERT_TRUE(client.read(response));
  std::jthread stopping([&] { server.server().stop(std::chrono::minutes(5)); });
  EXPECT_TRUE(eventually(
      [&] { return LiveClient(server).exchange(messages).status.error_code() == grpc::StatusCode::UNAVAILABLE; }));
  client.end_path();
  const LiveAnswer answer = client.read_all();
  EXPECT_TRUE(answer.status.ok()) << answer.status.error_message();
  EXPECT_EQ(answer.plans.size(), 1U);
}

}  // namespace
}  // namespace kcs::service::test
