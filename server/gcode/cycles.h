// The canned cycles of drilling: G73, G81 to G83, G85, G86 and G89.
#pragma once

#include <functional>
#include <optional>

#include "server/gcode/codes.h"
#include "server/gcode/coordinates.h"
#include "server/gcode/modes.h"
#include "server/gcode/words.h"

namespace kcs::gcode {

// One step of a cycle.
struct CycleStep {
  enum class Kind { kRapid, kFeed, kDwell, kStopSpindle, kRestartSpindle };
  Kind kind = Kind::kRapid;
  Stated to;            // in the program's coordinates, mm; what is not stated stays as it is
  double duration = 0;  // of a dwell, s
};

// What the cycle in force has been told, and the steps that follow from it. As LinuxCNC does them.
class Cycles {
 public:
  using TakeStep = std::function<void(const CycleStep&)>;

  // Executes a block under the cycle in force, modes.cycle: every hole that it asks for. `position`: where the tool is
  // in the program's coordinates, mm. What a block does not state (depth, R, P, Q) holds from the one before. Refuses
  // what is missing or makes no sense, naming the place.
  void execute(const Words& words, const Modes& modes, const Vector& position, const TakeStep& take);

  // A motion other than a cycle, or G80, came: what was stated is forgotten.
  void end() { *this = {}; }

 private:
  // Along the axis of the drill, in the program's coordinates, mm.
  struct Heights {
    double bottom = 0;
    double retract = 0;  // R
    double clear = 0;    // where the tool leaves the hole
  };

  void read(const Words& words, const Modes& modes);
  Heights heights(const Words& words, const Modes& modes) const;
  void drill(const Heights& heights, int axis, const TakeStep& take) const;
  void peck(const Heights& heights, int axis, const TakeStep& take) const;

  int cycle_ = kNoCode;  // the word for which the following was stated
  int axis_ = 2;
  std::optional<double> depth_;    // the word of the drill's axis, mm
  std::optional<double> retract_;  // R, mm
  std::optional<double> dwell_;    // P, s
  std::optional<double> peck_;     // Q, mm
  std::optional<double> initial_;  // where the tool was along the drill's axis when the cycles began, mm
};

}  // namespace kcs::gcode
