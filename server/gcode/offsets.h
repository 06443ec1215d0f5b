// The words that shift the program's coordinates: G10, G52, G92, G54 to G59.3, and tool lengths.
#pragma once

#include <map>

#include "server/gcode/codes.h"
#include "server/gcode/coordinates.h"
#include "server/gcode/notices.h"
#include "server/gcode/words.h"

namespace kcs::gcode {

class Offsets {
 public:
  // `notices` must outlive the object.
  explicit Offsets(Notices& notices) : notices_(notices) {}

  const Coordinates& coordinates() const { return coordinates_; }

  // Takes over the tool, its length and the work offset of a block, which hold for the block itself. `unit`: the
  // program's unit of length, mm.
  void choose(const Words& words, const Codes& codes, double unit);

  // Executes the block's G10, G52 or G92 to G92.3, if it has one. `position`: where the tool is in machine
  // coordinates, mm. Nothing moves; the coordinates change under the tool. Refuses what sets something that kcs does
  // not have, naming the place.
  void set(const Words& words, const Codes& codes, double unit, const Vector& position);

 private:
  void choose_tool_length(const Words& words, const Codes& codes, double unit);
  Vector length_of_tool(const Words& words, Place place);
  void set_stored(const Words& words, const Codes& codes, double unit, const Vector& position);
  void set_work_offset(const Words& words, double unit, const Vector& position, bool by_position);
  void set_tool(const Words& words, double unit);
  void set_local(const Words& words, const Codes& codes, double unit, const Vector& position);

  Notices& notices_;
  Coordinates coordinates_;
  Vector saved_local_ = Vector::Zero();  // what G92.3 brings back
  std::map<int, Vector> tools_;          // that the program has measured out with G10 L1, by number
  int selected_tool_ = 0;                // by T
  int tool_ = 0;                         // in the spindle, since M6
};

}  // namespace kcs::gcode
