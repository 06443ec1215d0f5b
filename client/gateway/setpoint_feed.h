// Keeps the player's queue filled from the server.
#pragma once

#include <atomic>
#include <cstdint>
#include <optional>
#include <string>
#include <thread>

#include "client/gateway/plan_source.h"
#include "client/gateway/player.h"

namespace kcs::gateway {

struct FeedOptions {
  std::size_t axes = 3;                     // of the plan's machine, 2 or 3
  double period_s = 0.001;                  // between two setpoints
  std::optional<std::uint64_t> last_index;  // last setpoint wanted; none: to the end of the path
  std::size_t capacity = 1000;              // setpoints that the queue holds, at least 8
};

// Streams a plan's setpoints into a queue, on a thread of its own. When the queue is full it reads no further, so the
// server waits too. When the stream breaks it is taken up again at the next index, after a pause that doubles from 50
// ms to 1 s; meanwhile the player plays from the queue. It gives up when ten seconds of trying have brought nothing, or
// when the server says that trying again will not help.
class SetpointFeed {
 public:
  // source: has obtained its plan. Begins at once; destroying the feed breaks any call off.
  SetpointFeed(PlanSource source, const FeedOptions& options);

  SetpointQueue& queue() { return queue_; }

  // Nothing more will be put on the queue: all is there, or the feed gave up.
  bool ended() const { return ended_.load(std::memory_order_acquire); }

  // Stops the feed. Returns why setpoints are missing; empty if all have come. Call once, before resumptions().
  std::string finish();

  // How often a broken stream has been taken up again.
  std::uint64_t resumptions() const { return resumptions_; }

 private:
  void run(const std::stop_token& stop);
  void fetch(const std::stop_token& stop);
  void check(const client::SetpointBatch& batch) const;
  void put(const client::SetpointBatch& batch);

  SetpointQueue queue_;
  PlanSource source_;
  FeedOptions options_;
  std::uint64_t next_index_ = 0;
  bool broken_ = false;    // a stream broke, and nothing has come since
  bool complete_ = false;  // the last setpoint is on the queue
  std::string trouble_;    // why the stream broke
  std::uint64_t resumptions_ = 0;
  std::atomic<bool> ended_ = false;
  std::jthread thread_;  // last: it uses all the others
};

}  // namespace kcs::gateway
