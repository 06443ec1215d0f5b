// Judges commands by themselves: whether they ever break a limit of the machine.
#pragma once

#include "client/gateway/player/player.h"

namespace kcs::test {

class LimitWatch {
 public:
  explicit LimitWatch(const kcs_player_profile& profile) : profile_(profile) {}

  // The command of the next tick. The first one is where the machine stands.
  void see(const double* command_mm);

  // The largest velocity, acceleration or jerk so far, of any axis, as a share of its limit.
  double largest_share() const { return largest_; }

 private:
  kcs_player_profile profile_;
  double before_[3][KCS_PLAYER_AXES] = {};
  bool began_ = false;
  double largest_ = 0;
};

}  // namespace kcs::test
