// Player and gateway in two threads, as they are in two processes: for ThreadSanitizer.
#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <thread>

#include "tests/unit/gateway/player/player_at_work.h"

namespace kcs::test {
namespace {

// The gateway's side: sees of the player no more than its memory.
class Gateway {
 public:
  explicit Gateway(PlayerAtWork& work)
      : memory_(*work.memory), line_(work.line), run_(work.line, work.limits, work.kPeriodS, work.kBatch, 20) {}

  // Feeds a run to its end, and stops it now and then.
  void play_a_run() {
    run_.begin(1, 0, 0, 0);
    for (bool begun = false; !begun || report_.state != KCS_PLAYER_READY;) {
      if (!read()) continue;
      begun = begun || report_.state == KCS_PLAYER_RUNNING;
      if (report_.state == KCS_PLAYER_HELD && report_.branch != branch_) {
        branch_ = report_.branch;
        run_.begin(1, branch_, report_.played, line_.place_of(report_.command_mm));
      }
      if (report_.state == KCS_PLAYER_RUNNING && report_.played > 200 * (stops_ + 1)) stop();
      kcs_player_batch* slot = run_.over() ? nullptr : kcs_player_free_slot(&memory_);
      if (!slot) {
        std::this_thread::yield();
        continue;
      }
      run_.write(*slot);
      kcs_player_put(&memory_);
    }
  }

  const kcs_player_report& report() const { return report_; }
  std::uint64_t stops() const { return stops_; }

 private:
  bool read() {
    const std::uint64_t ticks = report_.ticks;
    if (!kcs_player_read(&memory_, &report_)) return false;
    EXPECT_GE(report_.ticks, ticks) << "reports go back";
    EXPECT_LT(line_.distance_to(report_.command_mm), 1e-9) << "parts of two reports";
    return true;
  }

  void stop() {
    kcs_player_ask_to_stop(&memory_);
    ++stops_;
    while (!read() || report_.stops_obeyed != stops_) std::this_thread::yield();
  }

  kcs_player_memory& memory_;
  Line line_;
  LineRun run_;
  kcs_player_report report_{};
  std::uint64_t branch_ = 0, stops_ = 0;
};

TEST(PlayerThreads, AGatewayInAnotherThreadFeedsStopsAndReads) {
  PlayerAtWork work;
  work.line.origin = {0, 0, 0};
  std::fill(std::begin(work.input.actual_mm), std::end(work.input.actual_mm), 0.0);
  work.switch_on();
  Gateway gateway(work);
  std::atomic<bool> over = false;
  std::thread drives([&] {
    while (!over) {
      work.tick();
      std::this_thread::sleep_for(std::chrono::microseconds(20));
    }
  });
  gateway.play_a_run();
  over = true;
  drives.join();
  EXPECT_GT(gateway.stops(), 0u);
  EXPECT_EQ(gateway.report().stops_obeyed, gateway.stops());
  EXPECT_EQ(gateway.report().refused, 0u);
  EXPECT_NEAR(work.place(), 20, 1e-9);
  EXPECT_LE(work.watch.largest_share(), kAtTheLimit);
}

}  // namespace
}  // namespace kcs::test
