#include "server/gcode/cycles.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "server/gcode/lengths.h"

namespace kcs::gcode {
namespace {

constexpr double kMaxRepeats = 1e6;
constexpr double kMillimetresPerInch = 25.4;
// Between the end of the rapid back into the hole and where the peck before it ended: 0.01 inches, or that in mm.
constexpr double kPeckClearance = 0.01 * kMillimetresPerInch;
constexpr double kSmallestPeck = 0.001;  // mm
// Heights closer to each other differ by rounding, mm.
constexpr double kRounding = 1e-6;

CycleStep along(int axis, double to, CycleStep::Kind kind) {
  CycleStep step{.kind = kind, .to = {}};
  step.to[static_cast<std::size_t>(axis)] = to;
  return step;
}

int repeats_of(const Words& words) {
  if (!words.has('L')) return 1;
  const double repeats = words.value('L');
  if (repeats < 1 || repeats > kMaxRepeats || repeats != std::floor(repeats)) {
    refuse(words.place('L'), "L of a canned cycle counts its holes: a whole number from 1 to 1000000.");
  }
  return static_cast<int>(repeats);
}

bool dwells(int cycle) { return cycle == code(82) || cycle == code(86) || cycle == code(89); }
bool pecks(int cycle) { return cycle == code(73) || cycle == code(83); }

}  // namespace

void Cycles::execute(const Words& words, const Modes& modes, const Vector& position, const TakeStep& take) {
  read(words, modes);
  const int axis = modes.plane.normal;
  if (!initial_) initial_ = position[axis];
  const Heights heights = this->heights(words, modes);
  double height = position[axis];
  if (*initial_ < heights.retract) {
    take(along(axis, heights.retract, CycleStep::Kind::kRapid));
    height = heights.retract;
  }
  Vector hole = position;
  const int repeats = repeats_of(words);
  for (int repeat = 0; repeat < repeats; ++repeat) {
    const double first_height = repeat == 0 && height > heights.retract + kRounding ? height : heights.clear;
    CycleStep approach = along(axis, first_height, CycleStep::Kind::kRapid);
    const Stated stated = stated_move(words, modes.unit, modes.incremental, hole);
    for (const int side : {modes.plane.first, modes.plane.second}) {
      const std::optional<double>& value = stated[static_cast<std::size_t>(side)];
      if (!value) continue;
      hole[side] = modes.incremental ? hole[side] + *value : *value;
      approach.to[static_cast<std::size_t>(side)] = hole[side];
    }
    take(approach);
    take(along(axis, heights.retract, CycleStep::Kind::kRapid));
    drill(heights, axis, take);
  }
}

// What a block states holds for those after it, until another cycle or plane is chosen.
void Cycles::read(const Words& words, const Modes& modes) {
  if (modes.cycle != cycle_ || modes.plane.normal != axis_) {
    const std::optional<double> initial = modes.plane.normal == axis_ ? initial_ : std::nullopt;
    end();
    initial_ = initial;
    cycle_ = modes.cycle;
    axis_ = modes.plane.normal;
  }
  const char depth = axis_letter(axis_);
  const std::string name = code_name('G', cycle_);
  if (words.has(depth)) depth_ = length_of(words, depth, modes.unit);
  if (words.has('R')) retract_ = length_of(words, 'R', modes.unit);
  if (words.has('P')) dwell_ = words.value('P');
  if (words.has('Q')) peck_ = length_of(words, 'Q', modes.unit);
  if (!depth_) refuse(words.start(), name + " needs the depth of its hole: " + depth + " in this block.");
  if (!retract_) refuse(words.start(), name + " needs R, where the feed begins, in this block.");
  if (dwells(cycle_) && !dwell_) refuse(words.start(), name + " needs its dwell: P in seconds, in this block.");
  if (dwells(cycle_) && *dwell_ < 0) refuse(words.place('P'), "a dwell below zero. P is a time in seconds.");
  if (pecks(cycle_) && !peck_) refuse(words.start(), name + " needs the depth of each peck: Q in this block.");
  if (pecks(cycle_) && *peck_ < kSmallestPeck) {
    refuse(words.has('Q') ? words.place('Q') : words.start(), "Q, the depth of each peck, must be at least 0.001 mm.");
  }
}

Cycles::Heights Cycles::heights(const Words& words, const Modes& modes) const {
  Heights heights;
  heights.retract = modes.incremental ? *initial_ + *retract_ : *retract_;
  heights.bottom = modes.incremental ? heights.retract + *depth_ : *depth_;
  heights.clear = modes.retracts_to_r ? heights.retract : std::max(*initial_, heights.retract);
  if (heights.bottom < heights.retract) return heights;
  refuse(words.start(), "the bottom of the hole must lie below R: " + std::to_string(heights.bottom) + " mm and " +
                            std::to_string(heights.retract) +
                            " mm. Check both; under G91 R counts from where the tool is, the depth from R.");
}

void Cycles::drill(const Heights& heights, int axis, const TakeStep& take) const {
  using Kind = CycleStep::Kind;
  if (pecks(cycle_)) {
    peck(heights, axis, take);
  } else {
    take(along(axis, heights.bottom, Kind::kFeed));
  }
  if (dwells(cycle_)) take({.kind = Kind::kDwell, .to = {}, .duration = *dwell_});
  if (cycle_ == code(85)) take(along(axis, heights.retract, Kind::kFeed));
  if (cycle_ == code(86)) take({.kind = Kind::kStopSpindle, .to = {}});
  take(along(axis, heights.clear, cycle_ == code(89) ? Kind::kFeed : Kind::kRapid));
  if (cycle_ == code(86)) take({.kind = Kind::kRestartSpindle, .to = {}});
}

// G83 leaves the hole after each peck, to clear it of chips; G73 only breaks them.
void Cycles::peck(const Heights& heights, int axis, const TakeStep& take) const {
  using Kind = CycleStep::Kind;
  double depth = heights.retract - *peck_;
  while (depth > heights.bottom + kRounding) {
    take(along(axis, depth, Kind::kFeed));
    if (cycle_ == code(83)) take(along(axis, heights.retract, Kind::kRapid));
    take(along(axis, depth + kPeckClearance, Kind::kRapid));
    depth -= *peck_;
  }
  take(along(axis, heights.bottom, Kind::kFeed));
}

}  // namespace kcs::gcode
