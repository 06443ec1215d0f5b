// What a machine is sent of a run, and when.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>
#include <vector>

#include "server/runs/batch_maker.h"

namespace kcs::runs {

// Where a batch ends: how many setpoints of the run come before, and the plan's clock there.
struct BatchEnd {
  std::uint64_t tick = 0;
  ClockState clock;
};

// How far a machine has come with a run, as it says.
struct MachinePosition {
  std::uint64_t branch = 0;     // how often it has left the stream of batches
  std::uint64_t played = 0;     // setpoints that are out
  std::uint64_t committed = 0;  // that cannot be replaced any more
  std::vector<BatchEnd> ends;   // of the batches that it holds beyond, the last one where the next has to begin; ≥ 1
};

struct FeedOptions {
  BatchOptions batch;
  std::uint64_t window = 250;  // setpoints that the machine holds unplayed, at most a batch more
  std::uint64_t margin = 40;   // setpoints that it may play before a replacement reaches it

  bool operator==(const FeedOptions&) const = default;
};

struct NumberedBatch {
  std::uint64_t branch = 0;
  BatchEnd begin;
  Batch batch;
};

// Keeps a machine's window full. A new pace begins at the first batch that can still be replaced. It keeps no secrets:
// from what the machine says of its position another feed, on another server, goes on. For one thread at a time.
class RunFeed {
 public:
  // The plan must outlive it.
  RunFeed(const planning::Plan& plan, const motion::AxisLimits& limits, const FeedOptions& options)
      : options_(options), batches_(plan, limits, options.batch) {}

  // Begins, or begins anew, where the machine is. A new pace that has not reached it yet is tried again, later.
  void go_on_from(const MachinePosition& position);
  // Sends nothing until it begins anew.
  void pause() { sent_.clear(); }

  // What the machine says now. If it has left the stream, the feed pauses.
  void update(const MachinePosition& position);
  // The pace from now on: see BatchMaker.
  void set_rate(double rate);
  double rate() const { return rate_; }

  // The next batch, if the machine should have one now. Throws std::runtime_error if none can be made: the machine is
  // going to stop by the last one's tail.
  std::optional<NumberedBatch> next();

  // Where in the plan the machine is, about, s.
  double plan_time() const { return plan_time_; }

 private:
  void replace_from(std::uint64_t tick);

  FeedOptions options_;
  BatchMaker batches_;
  double rate_ = 1;
  bool replace_ = false;                         // what was sent for another pace
  std::uint64_t margin_ = 0;                     // of the replacement
  std::optional<std::uint64_t> replacing_from_;  // where the last one began; none once that was long ago
  bool ended_ = false;                           // the end of the plan was sent
  std::uint64_t branch_ = 0, played_ = 0, committed_ = 0;
  std::deque<BatchEnd> sent_;  // from the last one that was played on; none: it pauses
  double plan_time_ = 0;
};

}  // namespace kcs::runs
