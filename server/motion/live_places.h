// The places on the path that belong to the setpoints of a motion while it is still being made.
#pragma once

#include <cstdint>
#include <deque>

#include "server/motion/progress.h"

namespace kcs::motion {

// Gives the places that PlaceSampler gives of the whole trajectory. Memory: that of the path and of the motion from the
// next setpoint on.
class LivePlaces {
 public:
  // start: of the path, mm. period: s, > 0.
  LivePlaces(const Vector& start, double period) : path_(start), period_(period) {}
  // Its parts refer to each other.
  LivePlaces(const LivePlaces&) = delete;
  LivePlaces& operator=(const LivePlaces&) = delete;

  // The next segment of the path, as Path takes it; it comes before the phases that follow it.
  void add(const Vector& end, std::uint32_t line = 0) { path_.add(end, line); }
  // The next phase; it starts exactly when the one before it ends.
  void add(const Phase& phase);

  // The place of the next setpoint that is not the last one of the motion. Phases have come up to its time.
  Place next();
  // That of the last one.
  Place end() const { return path_.end(); }

  // From the last place that was given on.
  const Path& path() const { return path_; }

 private:
  void go_to(double time);

  Path path_;
  double period_;
  Progress progress_{path_};
  std::deque<Phase> phases_;  // the first one is the last that progress_ knows
  std::uint64_t given_ = 0;
};

}  // namespace kcs::motion
