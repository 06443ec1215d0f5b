#include "tests/bench/cycle_times/motion_record.h"

#include <algorithm>
#include <fstream>
#include <stdexcept>

#include "server/motion/sampler.h"
#include "tests/bench/path_follower.h"

namespace kcs::bench {

MotionRecord read_record(const std::string& file) {
  std::ifstream stream(file);
  MotionRecord record;
  for (planning::Vector at; stream >> at.x() >> at.y() >> at.z();) record.push_back(at);
  if (!stream.eof() || record.empty()) {
    throw std::runtime_error(file + " is no complete record of LinuxCNC; run ./run bench cycle-times again");
  }
  return record;
}

MotionRecord record_of(const motion::Trajectory& trajectory) {
  motion::Sampler sampler(trajectory, kPeriod);
  MotionRecord record;
  for (std::uint64_t i = 0; i < sampler.count(); ++i) record.push_back(sampler.at(i).state.position);
  return record;
}

Measures measure(const MotionRecord& record, double feed, const planning::Toolpath& path, double tolerance) {
  constexpr double kNearlyFeed = 0.995;
  PathFollower follower(path, tolerance);
  Measures measures;
  std::size_t first = 0, last = 0, at_feed = 0;
  for (std::size_t i = 1; i < record.size(); ++i) {
    const double step = (record[i] - record[i - 1]).norm();
    if (step > 0) {
      last = i;
      if (first == 0) first = i;
    }
    if (step >= kNearlyFeed * feed * kPeriod) ++at_feed;
    measures.deviation = std::max(measures.deviation, follower.follow(record[i]).distance);
  }
  const auto periods = static_cast<double>(last - first + 1);
  return {periods * kPeriod, static_cast<double>(at_feed) / periods, measures.deviation};
}

}  // namespace kcs::bench
