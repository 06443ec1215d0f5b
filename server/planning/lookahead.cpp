#include "server/planning/lookahead.h"

#include <algorithm>

#include "server/planning/leg_profile.h"
#include "server/planning/search.h"
#include "server/planning/stopped.h"

namespace kcs::planning {
namespace {

// One leg with the corners at its ends.
struct Span {
  const Leg& leg;
  const Cornering& entry;
  const Cornering& exit;

  // How much longer the leg would have to be, mm; ≤ 0: it is long enough.
  double excess(double entry_speed, double exit_speed) const {
    return needed_length(leg, entry.at(entry_speed), exit.at(exit_speed)) - leg.length;
  }
  bool possible(double entry_speed, double exit_speed) const { return excess(entry_speed, exit_speed) <= 0; }
  double slack() const { return kUnusedShare * leg.length; }
  double entry_level(double speed) const { return entry.at(speed).level(leg.jerk); }
  double exit_level(double speed) const { return exit.at(speed).level(leg.jerk); }
};

class LookAhead {
 public:
  LookAhead(std::span<const Stage> stages, const CornerMotion& entry, const std::stop_token& stop)
      : stages_(stages), entry_(Settled{entry}), stop_(stop) {
    for (const Stage& stage : stages) speeds_.push_back(stage.exit.max_speed());
  }

  std::optional<std::vector<double>> run() {
    for (std::size_t i = 0; i < stages_.size(); ++i) level(i);
    do {
      for (std::size_t i = stages_.size(); i-- > 1;) brake(i);
      again_ = false;
      for (std::size_t i = 0; i < stages_.size(); ++i) accelerate(i);
    } while (again_);
    if (!stages_[0].stretch && !span(0).possible(entry_speed(0), speeds_[0])) return {};
    return std::move(speeds_);
  }

 private:
  Span span(std::size_t i) const { return {stages_[i].leg, i == 0 ? entry_ : stages_[i - 1].exit, stages_[i].exit}; }
  double entry_speed(std::size_t i) const { return i == 0 ? entry_.max_speed() : speeds_[i - 1]; }

  // Lowers the greatest speeds of both corners to a common level that the leg can carry.
  void level(std::size_t i) {
    throw_if_stopped(stop_);
    if (stages_[i].stretch) return;
    const Span span = this->span(i);
    const double entry_cap = span.entry.max_speed(), exit_cap = span.exit.max_speed();
    if (span.possible(entry_cap, exit_cap)) return;
    const auto entry_at = [&](double level) { return span.entry.speed_at_level(level, span.leg.jerk); };
    const auto exit_at = [&](double level) { return span.exit.speed_at_level(level, span.leg.jerk); };
    const double common =
        largest_fitting(0, std::max(span.entry_level(entry_cap), span.exit_level(exit_cap)), span.slack(),
                        [&](double level) { return span.excess(entry_at(level), exit_at(level)); });
    if (i > 0) speeds_[i - 1] = std::min(speeds_[i - 1], entry_at(common));
    speeds_[i] = std::min(speeds_[i], exit_at(common));
  }

  // Lowers the entry of stage i until the tool can brake to its exit.
  void brake(std::size_t i) {
    throw_if_stopped(stop_);
    double& entry = speeds_[i - 1];
    const double exit = speeds_[i];
    if (stages_[i].stretch) {
      entry = std::min(entry, stages_[i].stretch->plan({entry, exit}).entry);
      return;
    }
    const Span span = this->span(i);
    if (span.possible(entry, exit) || span.entry_level(entry) <= span.exit_level(exit)) return;
    const double equal = std::min(entry, span.entry.speed_at_level(span.exit_level(exit), span.leg.jerk));
    entry = largest_fitting(equal, entry, span.slack(), [&](double speed) { return span.excess(speed, exit); });
  }

  // Lowers the exit of stage i until it can be reached from its entry.
  void accelerate(std::size_t i) {
    throw_if_stopped(stop_);
    const double entry = entry_speed(i);
    double& exit = speeds_[i];
    if (stages_[i].stretch) {
      const EndSpeeds ends = stages_[i].stretch->plan({entry, exit});
      exit = ends.exit;
      if (i > 0 && ends.entry < entry) {
        speeds_[i - 1] = ends.entry;
        again_ = true;
      }
      return;
    }
    const Span span = this->span(i);
    if (span.possible(entry, exit)) return;
    const double equal = std::min(exit, span.exit.speed_at_level(span.entry_level(entry), span.leg.jerk));
    exit = largest_fitting(equal, exit, span.slack(), [&](double speed) { return span.excess(entry, speed); });
  }

  std::span<const Stage> stages_;
  Cornering entry_;
  const std::stop_token& stop_;
  std::vector<double> speeds_;
  bool again_ = false;
};

}  // namespace

std::optional<std::vector<double>> corner_speeds(std::span<const Stage> stages, const CornerMotion& entry,
                                                 const std::stop_token& stop) {
  return LookAhead(stages, entry, stop).run();
}

}  // namespace kcs::planning
