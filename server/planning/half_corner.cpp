#include "server/planning/half_corner.h"

#include <algorithm>
#include <limits>

namespace kcs::planning {
namespace {

// Ends of phases that are nearer to each other than this, against the whole, are one.
constexpr double kSameInstant = 1e-12;

double duration_of(const motion::Jlap& profile) {
  return profile[0].duration + profile[1].duration + profile[2].duration;
}

// What a profile does from one instant to the next.
class Cursor {
 public:
  Cursor(const motion::Jlap& profile, double nothing) : profile_(profile), nothing_(nothing) { advance(0); }

  bool ended() const { return index_ == profile_.size(); }
  double left() const { return ended() ? std::numeric_limits<double>::infinity() : profile_[index_].duration - done_; }
  double jerk() const { return ended() ? 0 : profile_[index_].jerk; }

  void advance(double time) {
    done_ += time;
    while (left() <= nothing_) {
      ++index_;
      done_ = 0;
    }
  }

 private:
  const motion::Jlap& profile_;
  double nothing_;
  std::size_t index_ = 0;
  double done_ = 0;  // of the phase
};

}  // namespace

HalfState HalfState::after(const HalfPhase& phase) const {
  return {motion::LinearPhase{phase.duration, phase.along}.end(along),
          motion::LinearPhase{phase.duration, phase.across}.end(across)};
}

HalfCorner::HalfCorner(const motion::Jlap& along, const motion::Jlap& across) {
  const double nothing = kSameInstant * duration_of(across);
  Cursor on(along, nothing), to(across, nothing);
  while (!to.ended()) {
    const double duration = std::min(on.left(), to.left());
    phases_[count_++] = {duration, on.jerk(), to.jerk()};
    on.advance(duration);
    to.advance(duration);
  }
}

}  // namespace kcs::planning
