#include "client/gateway/playback.h"

#include <gtest/gtest.h>

#include "client/sdk/error.h"
#include "tests/unit/gateway/fake_server.h"

namespace kcs::gateway {
namespace {

PlaybackResult play_fast(const FakeServer& server, double patience_s) {
  PlanSource source({.address = server.address()}, FakeServer::kPlan);
  const client::Plan plan = source.obtain();
  PlaybackOptions options;
  options.simulated_time = true;
  options.patience_s = patience_s;
  return play(std::move(source), plan, options);
}

TEST(Playback, PlaysThePlanToItsEnd) {
  const FakeServer server;
  const PlaybackResult result = play_fast(server, 30);
  EXPECT_EQ(result.state, PlayState::kFinished);
  EXPECT_EQ(result.figures.ticks, FakeServer::kSetpoints);
  EXPECT_EQ(result.feed_failure, "");
}

TEST(Playback, SimulatedTimeWaitsForAHangingServerOnlySoLong) {
  FakeServer server;
  server.on_stream = [](grpc::ServerContext& context, const FakeServer::Request& request, FakeServer::Writer& writer) {
    writer.Write(FakeServer::batch(request.first_index(), 99));
    return FakeServer::hang(context);
  };
  const PlaybackResult result = play_fast(server, 0.2);
  EXPECT_EQ(result.state, PlayState::kStarved);
  EXPECT_EQ(result.figures.ticks, 100u);
  EXPECT_EQ(result.feed_failure, "the server sent nothing from setpoint 100 on");
}

TEST(Playback, SlowServersAreWaitedForAsLongAsSetpointsCome) {
  FakeServer server;
  server.on_stream = [](grpc::ServerContext&, const FakeServer::Request& request, FakeServer::Writer& writer) {
    for (std::uint64_t first = request.first_index(); first < FakeServer::kSetpoints; first += 250) {
      std::this_thread::sleep_for(std::chrono::milliseconds(200));
      writer.Write(FakeServer::batch(first, first + 249));
    }
    return grpc::Status::OK;
  };
  EXPECT_EQ(play_fast(server, 0.5).state, PlayState::kFinished);
}

TEST(Playback, RefusesAPlanThatDoesNotEndAtRest) {
  FakeServer server;
  server.end_speed = 10;
  EXPECT_THROW(play_fast(server, 1), client::Error);
}

}  // namespace
}  // namespace kcs::gateway
