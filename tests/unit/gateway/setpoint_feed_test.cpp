#include "client/gateway/setpoint_feed.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <filesystem>
#include <fstream>

#include "tests/unit/gateway/fake_server.h"

namespace kcs::gateway {
namespace {

using std::chrono::milliseconds;
using Clock = std::chrono::steady_clock;

constexpr milliseconds kAtOnce{2000};  // far less than any patience of the feed

PlanSource kept_plan(const FakeServer& server) {
  PlanSource source({.address = server.address()}, FakeServer::kPlan);
  source.obtain();
  return source;
}

FeedOptions options(std::size_t capacity = 100) {
  return {.axes = 2, .period_s = 0.001, .last_index = std::nullopt, .capacity = capacity};
}

template <typename Condition>
bool comes_true(Condition condition) {
  for (const auto end = Clock::now() + milliseconds(20'000); !condition() && Clock::now() < end;) {
    std::this_thread::sleep_for(milliseconds(1));
  }
  return condition();
}

// Takes everything that the feed brings, and checks that it is setpoint 0, 1, 2, … Returns how many there were.
std::uint64_t take_all(SetpointFeed& feed) {
  std::uint64_t taken = 0;
  const bool ended = comes_true([&] {
    const bool all_is_there = feed.ended();
    for (Setpoint setpoint; feed.queue().take(setpoint); ++taken) {
      EXPECT_EQ(setpoint.position_mm.x(), static_cast<double>(taken));
      EXPECT_EQ(setpoint.position_mm.y(), -static_cast<double>(taken));
      EXPECT_EQ(setpoint.last, taken == FakeServer::kSetpoints - 1);
    }
    return all_is_there;
  });
  EXPECT_TRUE(ended) << "the feed does not end";
  return taken;
}

// Stops the feed, which must not take long.
std::string finish(SetpointFeed& feed) {
  const auto begin = Clock::now();
  std::string trouble = feed.finish();
  EXPECT_LT(Clock::now() - begin, kAtOnce);
  return trouble;
}

TEST(SetpointFeed, BringsEverySetpointOnceThroughASmallQueue) {
  const FakeServer server;
  SetpointFeed feed(kept_plan(server), options(8));
  EXPECT_EQ(take_all(feed), FakeServer::kSetpoints);
  EXPECT_EQ(finish(feed), "");
  EXPECT_EQ(feed.resumptions(), 0u);
}

TEST(SetpointFeed, EndsWithTheLastSetpointAskedFor) {
  const FakeServer server;
  FeedOptions some = options();
  some.last_index = 10;
  SetpointFeed feed(kept_plan(server), some);
  ASSERT_TRUE(comes_true([&feed] { return feed.ended(); }));
  EXPECT_EQ(feed.queue().size(), 11u);
  Setpoint setpoint;
  while (feed.queue().take(setpoint)) EXPECT_EQ(setpoint.last, setpoint.position_mm.x() == 10);
  EXPECT_EQ(finish(feed), "");
}

TEST(SetpointFeed, AsksForNoMoreThanTheQueueHolds) {
  FakeServer server;
  std::atomic<std::uint64_t> asked_for = 0;
  server.on_stream = [&asked_for](grpc::ServerContext&, const FakeServer::Request& request,
                                  FakeServer::Writer& writer) {
    asked_for = request.last_index() + 1;
    writer.Write(FakeServer::batch(request.first_index(), FakeServer::last_of(request)));
    return grpc::Status::OK;
  };
  SetpointFeed feed(kept_plan(server), options(100));
  ASSERT_TRUE(comes_true([&asked_for] { return asked_for == 100; }));
  std::this_thread::sleep_for(milliseconds(50));
  EXPECT_EQ(asked_for, 100u);
  EXPECT_NE(finish(feed), "");
}

TEST(SetpointFeed, TakesABrokenStreamUpWhereItBroke) {
  FakeServer server;
  int streams = 0;
  std::uint64_t broken = 0;
  server.on_stream = [&streams, &broken](grpc::ServerContext&, const FakeServer::Request& request,
                                         FakeServer::Writer& writer) {
    const bool breaks = ++streams % 10 == 3;
    const std::uint64_t last = breaks ? request.first_index() + 2 : FakeServer::last_of(request);
    writer.Write(FakeServer::batch(request.first_index(), last));
    if (breaks) ++broken;
    return breaks ? grpc::Status(grpc::StatusCode::UNAVAILABLE, "cable pulled") : grpc::Status::OK;
  };
  SetpointFeed feed(kept_plan(server), options());
  EXPECT_EQ(take_all(feed), FakeServer::kSetpoints);
  EXPECT_EQ(finish(feed), "");
  EXPECT_GT(broken, 1u);
  EXPECT_EQ(feed.resumptions(), broken);
}

TEST(SetpointFeed, DoesNotTryAgainWhatCannotSucceed) {
  FakeServer server;
  server.on_stream = [](grpc::ServerContext&, const FakeServer::Request&, FakeServer::Writer&) {
    return grpc::Status(grpc::StatusCode::INVALID_ARGUMENT, "not like this");
  };
  const auto begin = Clock::now();
  SetpointFeed feed(kept_plan(server), options());
  EXPECT_EQ(take_all(feed), 0u);
  EXPECT_LT(Clock::now() - begin, kAtOnce);
  EXPECT_EQ(finish(feed), "not like this (INVALID_ARGUMENT, at setpoint 0)");
}

TEST(SetpointFeed, RefusesSetpointsThatItDidNotAskFor) {
  FakeServer server;
  server.on_stream = [](grpc::ServerContext&, const FakeServer::Request& request, FakeServer::Writer& writer) {
    writer.Write(FakeServer::batch(request.first_index() + 1, request.last_index()));
    return grpc::Status::OK;
  };
  SetpointFeed feed(kept_plan(server), options());
  EXPECT_EQ(take_all(feed), 0u);
  EXPECT_NE(finish(feed).find("not what it was asked for"), std::string::npos);
}

TEST(SetpointFeed, AStreamThatHangsDoesNotHoldUpTheEnd) {
  FakeServer server;
  server.on_stream = [](grpc::ServerContext& context, const FakeServer::Request&, FakeServer::Writer&) {
    return FakeServer::hang(context);
  };
  SetpointFeed feed(kept_plan(server), options());
  std::this_thread::sleep_for(milliseconds(100));
  EXPECT_FALSE(feed.ended());
  EXPECT_EQ(finish(feed), "the server sent nothing from setpoint 0 on");
}

// The server breaks the stream, has forgotten the plan, and hangs while it makes it again.
TEST(SetpointFeed, APlanningThatHangsDoesNotHoldUpTheEnd) {
  FakeServer server;
  const auto file = std::filesystem::path(testing::TempDir()) / (std::to_string(getpid()) + "-feed.ngc");
  std::ofstream(file) << "G1 X1 F1\n";
  PlanSource source({.address = server.address()}, Program{.file = file, .options = {}});
  source.obtain();
  std::atomic<bool> planning = false;
  server.on_stream = [](grpc::ServerContext&, const FakeServer::Request&, FakeServer::Writer&) {
    return grpc::Status(grpc::StatusCode::UNAVAILABLE, "starts again");
  };
  server.on_get = [](grpc::ServerContext&) { return grpc::Status(grpc::StatusCode::NOT_FOUND, "no such plan"); };
  server.on_create = [&planning](grpc::ServerContext& context) {
    planning = true;
    grpc::Status status = FakeServer::hang(context);
    planning = false;
    return status;
  };
  SetpointFeed feed(std::move(source), options());
  ASSERT_TRUE(comes_true([&planning] { return planning.load(); }));
  EXPECT_NE(finish(feed).find("starts again (UNAVAILABLE, at setpoint 0)"), std::string::npos);
  EXPECT_TRUE(comes_true([&planning] { return !planning; })) << "the server still plans for nobody";
  std::filesystem::remove(file);
}

}  // namespace
}  // namespace kcs::gateway
