// What goes to the drives at each tick.
#pragma once

#include <cstdint>

#include "client/gateway/one_way_queue.h"
#include "client/gateway/vector.h"

namespace kcs::gateway {

// A commanded position on its way to the drives.
struct Setpoint {
  Vector position_mm = Vector::Zero();
  bool last = false;  // nothing comes after it
};

using SetpointQueue = OneWayQueue<Setpoint>;

enum class PlayState {
  kReady,     // no tick yet; the machine stands at the start
  kPlaying,   // a new setpoint at each tick
  kFinished,  // the last setpoint is out
  kStarved,   // a tick found no setpoint: final
};

// The player's core: each tick takes the next setpoint off the queue. A tick neither allocates nor locks nor makes a
// system call, and takes the same time always; it may run in a real-time thread.
//
// Starvation is final: the position stays where it was, which real drives would see as a step in velocity. So this is
// an error that ends the run, fit for simulated drives only, until setpoints come with a stop tail (a planned motion to
// rest) that a starved player can play instead.
class Player {
 public:
  // Plays what is put on `queue`, which must outlive the player; the machine stands at `start_mm`.
  Player(SetpointQueue& queue, const Vector& start_mm) : queue_(queue), position_(start_mm) {}

  // One period goes by. Once finished or starved, the position stays and the state too.
  PlayState tick() noexcept {
    if (state_ == PlayState::kFinished || state_ == PlayState::kStarved) return state_;
    if (Setpoint next; queue_.take(next)) {
      position_ = next.position_mm;
      ++played_;
      state_ = next.last ? PlayState::kFinished : PlayState::kPlaying;
    } else {
      state_ = PlayState::kStarved;
    }
    return state_;
  }

  PlayState state() const { return state_; }

  // The position for the drives, mm.
  const Vector& position_mm() const { return position_; }

  // Setpoints played so far.
  std::uint64_t played() const { return played_; }

 private:
  SetpointQueue& queue_;
  Vector position_;
  PlayState state_ = PlayState::kReady;
  std::uint64_t played_ = 0;
};

}  // namespace kcs::gateway
