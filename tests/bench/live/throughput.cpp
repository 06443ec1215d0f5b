#include <algorithm>
#include <chrono>
#include <cmath>
#include <thread>

#include "client/sdk/planner.h"
#include "tests/bench/live/live_benchmarks.h"
#include "tests/bench/speed/paths.h"

namespace kcs::bench {
namespace {

constexpr std::size_t kPiece = 1000;  // points in a message

// A small circle's centre goes round a large circle, and never comes back to where it was.
void add_point(std::size_t index, client::PointPath& path) {
  constexpr double kStep = 0.1 / 75, kLarge = 40, kSmall = 12, kTurns = 6.283185307179586;  // rad; mm; per large turn
  const double angle = static_cast<double>(index) * kStep;
  path.points_mm.push_back(kLarge * std::cos(angle) + kSmall * std::cos(kTurns * angle));
  path.points_mm.push_back(kLarge * std::sin(angle) + kSmall * std::sin(kTurns * angle));
  path.points_mm.push_back(std::sin(angle / 7));
}

void send_curve(std::size_t segments, client::LiveStream& stream) {
  client::PointPath piece{.feed_mm_s = {kFeed}};
  for (std::size_t first = 0; first <= segments; first += kPiece) {
    piece.points_mm.clear();
    for (std::size_t i = first; i < std::min(first + kPiece, segments + 1); ++i) add_point(i, piece);
    if (!stream.send(piece)) return;
  }
  stream.end_path();
}

}  // namespace

client::PlanOptions live_options() {
  return {.machine = {.axes = 3,
                      .velocity_mm_s = {500, 500, 500},
                      .acceleration_mm_s2 = {kAcceleration, kAcceleration, kAcceleration},
                      .jerk_mm_s3 = {kJerk, kJerk, kJerk}},
          .tolerance_mm = kTolerance};
}

Throughput measure_throughput(const ServerProcess& server, std::size_t segments) {
  Throughput found;
  client::Planner planner(server.address());
  const auto begin = std::chrono::steady_clock::now();
  client::LiveStream stream = planner.plan_live(live_options(), {.period_s = 0.001});
  std::jthread sender([&] { send_curve(segments, stream); });
  for (client::SetpointBatch batch; stream.next(batch);) {
    found.setpoints += batch.size();
    if (batch.end_of_path) found.end_memory = server.memory();
  }
  found.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  found.most_memory = server.most_memory();
  return found;
}

}  // namespace kcs::bench
