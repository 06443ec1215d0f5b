#include "server/http/slow_spots.h"

#include <algorithm>
#include <utility>

namespace kcs::http {
namespace {

constexpr std::size_t kSpots = 10;

}  // namespace

void SlowSpots::add(const v1::Corner& corner) {
  if (!current_ || corner.line() == 0 || corner.line() != current_->worst.line()) {
    settle();
    current_ = Spot{.worst = corner};
  }
  if (corner.time_lost_s() > current_->worst.time_lost_s()) current_->worst = corner;
  ++current_->corners;
  current_->time_lost += corner.time_lost_s();
}

nlohmann::ordered_json SlowSpots::finish() {
  settle();
  auto spots = nlohmann::ordered_json::array();
  for (const Spot& spot : slowest_) {
    spots.push_back({{"line", spot.worst.line()},
                     {"point_mm", spot.worst.point_mm()},
                     {"corners", spot.corners},
                     {"angle_deg", spot.worst.angle_deg()},
                     {"speed_mm_s", spot.worst.speed_mm_s()},
                     {"time_lost_s", spot.time_lost}});
  }
  return spots;
}

void SlowSpots::settle() {
  if (!current_ || current_->time_lost <= 0) return;
  const auto place = std::upper_bound(slowest_.begin(), slowest_.end(), *current_,
                                      [](const Spot& a, const Spot& b) { return a.time_lost > b.time_lost; });
  slowest_.insert(place, *std::exchange(current_, std::nullopt));
  if (slowest_.size() > kSpots) slowest_.pop_back();
}

}  // namespace kcs::http
