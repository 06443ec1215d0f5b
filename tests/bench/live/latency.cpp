#include <algorithm>
#include <chrono>
#include <thread>
#include <vector>

#include "client/sdk/planner.h"
#include "server/planning/live_planner.h"
#include "tests/bench/live/live_benchmarks.h"
#include "tests/bench/program.h"
#include "tests/bench/speed/paths.h"

namespace kcs::bench {
namespace {

constexpr int kRounds = 21;
constexpr std::chrono::milliseconds kRest{50};  // so that the server has taken in what came before

class Notice : public planning::PlanReceiver {
 public:
  void take(const planning::Segment&) override {}
  void take(const motion::Phase&) override { moved_ = true; }
  void take(const planning::Corner&) override {}
  void take(const planning::MarkerAt&) override {}
  bool moved() const { return moved_; }

 private:
  bool moved_ = false;
};

double seconds_since(std::chrono::steady_clock::time_point begin) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

// How many segments of the path it takes until something is settled, and how long that takes with the last of them.
Latency look_ahead(const planning::Toolpath& path) {
  Latency found;
  Notice notice;
  planning::LivePlanner planner(path, machine(kAcceleration, kJerk), notice);
  while (!notice.moved()) {
    const auto begin = std::chrono::steady_clock::now();
    planner.add(path.segments.at(found.segments++));
    found.planning = seconds_since(begin);
  }
  return found;
}

client::PointPath points(const planning::Toolpath& path, std::size_t first, std::size_t end) {
  client::PointPath piece{.feed_mm_s = {kFeed}};
  for (std::size_t i = first; i < end; ++i) {
    const planning::Vector& point = i == 0 ? path.start : path.segments[i - 1].end;
    piece.points_mm.insert(piece.points_mm.end(), {point.x(), point.y(), point.z()});
  }
  return piece;
}

}  // namespace

Latency measure_latency(const ServerProcess& server, const planning::Toolpath& path) {
  Latency found = look_ahead(path);
  client::Planner planner(server.address());
  std::vector<double> seconds;
  for (int round = 0; round < kRounds; ++round) {
    client::LiveStream stream = planner.plan_live(live_options(), {.period_s = 0.001});
    stream.send(points(path, 0, found.segments));
    std::this_thread::sleep_for(kRest);
    const client::PointPath last = points(path, found.segments, found.segments + 1);
    const auto begin = std::chrono::steady_clock::now();
    stream.send(last);
    client::SetpointBatch batch;
    stream.next(batch);
    seconds.push_back(seconds_since(begin));
  }
  std::sort(seconds.begin(), seconds.end());
  found.median = seconds[seconds.size() / 2];
  found.largest = seconds.back();
  return found;
}

}  // namespace kcs::bench
