#include "tests/faults/judge.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "tests/faults/follower.h"

namespace kcs::faults {
namespace {

using motion::Vector;

constexpr double kMargin = 1e-6;   // of a limit, for rounding
constexpr double kOnCurve = 1e-7;  // mm
constexpr double kSame = 1e-11;    // mm: recordings are rounded to 15 digits, or to 1e-12 mm

class Judge {
 public:
  Judge(const motion::AxisLimits& limits, double period) : limits_(limits), period_(period) {
    before_.fill(Vector::Zero());
  }

  void begin(const Run& run) {
    end_run();
    run_ = &run;
    follower_.emplace(run.plan, period_);
  }

  void take(const Command& command) {
    const Vector& now = command.position;
    if (!verdict_.places.empty()) {
      look_at_limits(now);
    } else {
      before_.fill(now);
    }
    double distance = (now - before_[0]).norm();  // before the first run, where it stands
    if (follower_) distance = follower_->follow(now);
    verdict_.farthest = std::max(verdict_.farthest, distance);
    if (distance > kOnCurve) note(fmt::format("{:.6f} mm off the planned curve", distance));
    moves_ = now != before_[0];
    verdict_.places.push_back({run_, follower_ ? follower_->time() : 0, follower_ && follower_->as_planned(), moves_});
    before_ = {now, before_[0], before_[1]};
  }

  Verdict finish() {
    end_run();
    return std::move(verdict_);
  }

 private:
  void end_run() {
    if (moves_) note("it does not end at rest");
    if (run_ && run_->complete && (before_[0] - run_->plan.trajectory.final_state().position).norm() > kSame) {
      note("not at the end of the path");
    }
  }

  void look_at_limits(const Vector& now) {
    const auto& [one, two, three] = before_;
    const double rounding = 64 * std::numeric_limits<double>::epsilon() * std::max(1.0, now.cwiseAbs().maxCoeff());
    for (Eigen::Index i = 0; i < static_cast<Eigen::Index>(limits_.axes); ++i) {
      const std::array<std::pair<double, double>, 3> measured = {
          {{now[i] - one[i], limits_.velocity[i] * period_},
           {now[i] - 2 * one[i] + two[i], limits_.acceleration[i] * std::pow(period_, 2)},
           {now[i] - 3 * one[i] + 3 * two[i] - three[i], limits_.jerk[i] * std::pow(period_, 3)}}};
      for (std::size_t order = 0; order < measured.size(); ++order) {
        const auto [difference, most] = measured[order];
        const double share = std::max(0.0, std::abs(difference) - rounding) / most;
        verdict_.largest_share = std::max(verdict_.largest_share, share);
        if (share <= 1 + kMargin) continue;
        constexpr std::array kNames = {"velocity", "acceleration", "jerk"};
        note(fmt::format("{:.4f} of the limit of {} of axis {}", share, kNames[order], "XYZ"[i]));
      }
    }
  }

  void note(const std::string& what) {
    if (!verdict_.fault.empty()) return;
    verdict_.fault =
        fmt::format("tick {}: {}; {} s of the plan", verdict_.places.size(), what, follower_ ? follower_->time() : 0);
  }

  motion::AxisLimits limits_;
  double period_;
  Verdict verdict_;
  const Run* run_ = nullptr;
  std::optional<Follower> follower_;
  std::array<Vector, 3> before_;  // the latest first
  bool moves_ = false;
};

}  // namespace

Verdict judge(const Commands& commands, const Runs& runs, const motion::AxisLimits& limits, double period) {
  Judge judge(limits, period);
  auto next = runs.begin();
  for (const Command& command : commands) {
    for (; next != runs.end() && next->begun <= command.time; ++next) judge.begin(*next);
    judge.take(command);
  }
  return judge.finish();
}

}  // namespace kcs::faults
