#include "server/runs/batch_markers.h"

#include <algorithm>
#include <initializer_list>

namespace kcs::runs {
namespace {

using planning::MarkerKind;

// What has been switched again, seen from the end.
class SwitchedAgain {
 public:
  // Whether a later marker made this one void; and takes it in.
  bool makes_void(MarkerKind kind) {
    switch (kind) {
      case MarkerKind::kMistOn:
        return has({kind, MarkerKind::kCoolantOff}, kind);
      case MarkerKind::kFloodOn:
        return has({kind, MarkerKind::kCoolantOff}, kind);
      case MarkerKind::kCoolantOff:
        return has({kind}, kind);
      case MarkerKind::kDwellBegins:
      case MarkerKind::kDwellEnds:
        return has({MarkerKind::kDwellBegins, MarkerKind::kDwellEnds}, kind);
      case MarkerKind::kSpindleSpeedLimit:
        return has({kind}, kind);
      case MarkerKind::kSpindleSurfaceSpeed:
        return has({kind, MarkerKind::kSpindleClockwise, MarkerKind::kSpindleCounterclockwise, MarkerKind::kSpindleOff},
                   kind);
      default:
        return has({MarkerKind::kSpindleClockwise, MarkerKind::kSpindleCounterclockwise, MarkerKind::kSpindleOff},
                   kind);
    }
  }

 private:
  bool has(std::initializer_list<MarkerKind> kinds, MarkerKind taken) {
    const bool found = std::any_of(kinds.begin(), kinds.end(), [this](MarkerKind kind) { return seen_ & bit(kind); });
    seen_ |= bit(taken);
    return found;
  }
  static unsigned bit(MarkerKind kind) { return 1u << static_cast<unsigned>(kind); }

  unsigned seen_ = 0;
};

std::vector<BatchMarker> without_void(const std::vector<BatchMarker>& markers, std::size_t setpoints) {
  std::vector<BatchMarker> left;
  SwitchedAgain in_batch, in_tail;
  for (auto it = markers.rbegin(); it != markers.rend(); ++it) {
    SwitchedAgain& part = it->setpoint < setpoints ? in_batch : in_tail;
    if (!part.makes_void(it->marker.kind)) left.push_back(*it);
  }
  std::reverse(left.begin(), left.end());
  return left;
}

}  // namespace

std::vector<BatchMarker> markers_on(const MarkedCourse& course, const std::vector<planning::MarkerAt>& markers) {
  std::vector<BatchMarker> due;
  auto setpoint = course.times.begin();
  const auto first = std::partition_point(markers.begin(), markers.end(),
                                          [&](const planning::MarkerAt& it) { return it.time < course.from; });
  for (auto it = first; it != markers.end(); ++it) {
    while (setpoint != course.times.end() && *setpoint <= it->time) ++setpoint;
    if (setpoint == course.times.end() && !course.to_end) break;
    const auto index = static_cast<std::size_t>(setpoint - course.times.begin());
    due.push_back({std::min(index, course.times.size() - 1), it->marker});
  }
  return due.size() <= kMostMarkers ? due : without_void(due, course.setpoints);
}

}  // namespace kcs::runs
