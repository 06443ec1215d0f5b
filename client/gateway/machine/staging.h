// The batches of a run between the network and the player.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>
#include <string>

#include "client/gateway/player/player.h"
#include "kcs/v1/machine.pb.h"

namespace kcs::gateway {

// What became of a batch.
enum class Staged {
  kTaken,
  kStale,   // of another run or an earlier branch: it was on its way when the machine stopped; dropped
  kRefused  // damaged, or not where the motion held can go on; dropped
};

struct StagingResult {
  Staged staged = Staged::kTaken;
  std::string reason;  // of a refusal
};

// Holds what the server has sent ahead, and hands the player no more of it than it needs: what the player has cannot be
// replaced any more, what is staged can.
//
//   |-- played --|-- committed (the player's slots) --|-- staged --|
//             played                            committed        held
//
// A batch is taken if it begins at a batch end from `committed` to `held`; what was held beyond that end is void then.
// One that is held already changes nothing. When the player leaves the stream of batches (its branch rises), all that
// is staged is void, and the motion goes on from where the stop tail rests.
//
// For one run after another; by one thread at a time.
class Staging {
 public:
  // More are refused: a server that does not keep to the window must not fill the gateway's memory.
  static constexpr std::size_t kMostBatches = 1000;

  // commit_s: motion to be with the player, > 0.
  Staging(std::size_t axes, double period_s, double commit_s);

  // A run that begins at rest, before its first setpoint. `number` as the player knows it, from 1; plan_time_s: where
  // in the plan the machine stands.
  void begin(std::uint64_t number, double plan_time_s);
  // A run that the player has begun already, for another gateway before this one.
  void adopt(const kcs_player_report& report);

  // Takes a batch of this run, or says why not.
  StagingResult stage(const v1::MotionBatch& batch);

  // Drops what is staged.
  void clear() { staged_.clear(); }
  // The player, asked to stop before the run's first setpoint, has dropped what it was given.
  void go_back() { stand_at(origin_); }

  // What the player says. True if it has left the stream of batches since the last call, or has refused to begin.
  bool follow(const kcs_player_report& report);

  // Hands the player what is due; nothing while it rests and less than commit_s is there to begin with.
  void commit(kcs_player_memory& player);

  // RunPosition but for its run.
  v1::RunPosition position() const;

  std::uint64_t branch() const { return branch_; }

 private:
  const v1::BatchEnd& held() const { return staged_.empty() ? committed_ : staged_.back().end; }
  std::optional<std::string> find_gap(const v1::MotionBatch& batch) const;
  bool is_held_already(const v1::MotionBatch& batch) const;
  bool may_begin() const;
  void stand_at(const v1::BatchEnd& rest);

  struct Batch {
    v1::MotionBatch motion;
    v1::BatchEnd end;
  };

  std::size_t axes_;
  double period_;       // s
  double commit_time_;  // s
  std::uint64_t run_ = 0;
  std::uint64_t branch_ = 0;
  std::uint64_t played_ = 0;
  std::uint64_t refused_ = 0;  // by the player
  v1::BatchEnd origin_;        // where this branch begins, at rest
  v1::BatchEnd committed_;     // end of what the player was given
  bool flowing_ = false;       // something of this branch is with the player
  bool left_ = false;          // on the stop tail, or at its end
  bool at_rest_ = true;        // no setpoint is due from the player
  std::deque<Batch> staged_;
};

}  // namespace kcs::gateway
