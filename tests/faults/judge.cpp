#include "tests/faults/judge.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <limits>
#include <sstream>

namespace kcs::faults {
namespace {

using motion::Vector;

constexpr double kMargin = 1e-6;   // of a limit, for rounding
constexpr double kOnCurve = 1e-7;  // mm: recordings have 15 digits
constexpr double kFastest = 3;     // times the planned pace: no override allows more
constexpr int kHalvings = 60, kLooks = 16;

// Follows the planned curve from command to command.
class Follower {
 public:
  Follower(const planning::Plan& plan, double period) : plan_(plan), phase_(plan.trajectory.begin()), period_(period) {}

  // How far the command is from the nearest place of what can come next, mm.
  double distance(const Vector& command) {
    const double latest = std::min(time_ + kFastest * period_, plan_.trajectory.duration());
    double best = time_, least = (at(time_) - command).norm();
    if (least <= kOnCurve / 10) return least;  // it stands
    for (int i = 1; i <= kLooks; ++i) {
      const double time = time_ + (latest - time_) * i / kLooks;
      const double distance = (at(time) - command).norm();
      if (distance < least) {
        least = distance;
        best = time;
      }
    }
    const double step = (latest - time_) / kLooks;
    double low = std::max(time_, best - step), high = std::min(latest, best + step);
    for (int i = 0; i < kHalvings; ++i) {
      const double third = (high - low) / 3;
      ((at(low + third) - command).norm() < (at(high - third) - command).norm() ? high : low) =
          (at(low + third) - command).norm() < (at(high - third) - command).norm() ? high - third : low + third;
    }
    time_ = (low + high) / 2;
    return (at(time_) - command).norm();
  }

  double time() const { return time_; }

 private:
  Vector at(double time) {
    if (time < phase_->start_time || time >= phase_->end_time()) phase_.seek(time);
    return phase_->at(std::clamp(time - phase_->start_time, 0.0, phase_->duration)).position;
  }

  const planning::Plan& plan_;
  motion::Trajectory::Iterator phase_;
  double period_, time_ = 0;
};

}  // namespace

Commands read_recording(const std::filesystem::path& file) {
  std::ifstream in(file);
  std::string line;
  std::getline(in, line);
  const int axes = static_cast<int>(std::count(line.begin(), line.end(), ',')) / 2;
  Commands commands;
  while (std::getline(in, line)) {
    std::istringstream row(line);
    std::string cell;
    std::getline(row, cell, ',');
    Vector command = Vector::Zero();
    for (int axis = 0; axis < axes && std::getline(row, cell, ','); ++axis) command[axis] = std::stod(cell);
    commands.push_back(command);
  }
  return commands;
}

Verdict judge(const Commands& commands, const planning::Plan& plan, const motion::AxisLimits& limits, double period,
              bool complete) {
  Verdict verdict;
  Follower follower(plan, period);
  std::array<Vector, 3> before;
  before.fill(plan.start);
  bool moved = false;
  const auto note = [&verdict](std::size_t tick, const std::string& what) {
    if (verdict.fault.empty()) verdict.fault = fmt::format("tick {}: {}", tick, what);
  };
  for (std::size_t tick = 0; tick < commands.size(); ++tick) {
    const Vector& now = commands[tick];
    const auto& [one, two, three] = before;
    const double rounding = 64 * std::numeric_limits<double>::epsilon() * std::max(1.0, now.cwiseAbs().maxCoeff());
    for (Eigen::Index i = 0; i < static_cast<Eigen::Index>(limits.axes); ++i) {
      const std::array<std::pair<double, double>, 3> measured = {
          {{now[i] - one[i], limits.velocity[i] * period},
           {now[i] - 2 * one[i] + two[i], limits.acceleration[i] * std::pow(period, 2)},
           {now[i] - 3 * one[i] + 3 * two[i] - three[i], limits.jerk[i] * std::pow(period, 3)}}};
      for (std::size_t order = 0; order < measured.size(); ++order) {
        const auto [difference, most] = measured[order];
        const double share = std::max(0.0, std::abs(difference) - rounding) / most;
        verdict.largest_share = std::max(verdict.largest_share, share);
        if (share > 1 + kMargin) {
          constexpr std::array kNames = {"velocity", "acceleration", "jerk"};
          note(tick, fmt::format("{:.4f} of the limit of {} of axis {}", share, kNames[order], "XYZ"[i]));
        }
      }
    }
    const double distance = follower.distance(now);
    verdict.farthest = std::max(verdict.farthest, distance);
    if (distance > kOnCurve)
      note(tick, fmt::format("{:.6f} mm off the planned curve at {} s", distance, follower.time()));
    const bool moves = now != one;
    if (moved && !moves) ++verdict.stops;
    moved = moves;
    before = {now, one, two};
  }
  verdict.reached = follower.time();
  if (moved) note(commands.size(), "it does not end at rest");
  if (complete && before[0] != plan.trajectory.final_state().position)
    note(commands.size(), "not at the end of the path");
  return verdict;
}

}  // namespace kcs::faults
