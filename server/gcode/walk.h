// The way through the lines of a listing on which conditions and loops lead.
#pragma once

#include <cstddef>

#include "server/gcode/cursor.h"
#include "server/gcode/listing.h"
#include "server/gcode/nesting.h"
#include "server/gcode/o_word.h"
#include "server/gcode/parameters.h"

namespace kcs::gcode {

class Walk {
 public:
  // Begins at the first line of `listing`, which must outlive the walk. Lines may be added to it.
  explicit Walk(const Listing& listing) : listing_(&listing) {}

  // No line is left, or none has come yet.
  bool at_end() const { return next_ == listing_->size(); }
  // Goes behind the next line, which there must be.
  Line take() { return (*listing_)[next_++]; }
  // Whether the line that was taken last is to be executed.
  bool runs() const { return nesting_.runs(); }

  // Goes where the line that was taken last leads: its O word belongs to a condition or a loop, and what its keyword
  // takes is at the cursor. Refuses an O word that does not fit to those before it.
  void follow(const OWord& word, Cursor& cursor, const Parameters& parameters);

  // A subroutine begins at the line that was taken last: the lines up to its end are skipped.
  void open_subroutine(const OWord& word) { nesting_.open(word, Course::kOver, next_ - 1); }
  void close_subroutine(const OWord& word);

  const Nesting& nesting() const { return nesting_; }

  // The listing was cleared.
  void restart() { next_ = 0; }

 private:
  void follow_condition(const OWord& word, Cursor& cursor, const Parameters& parameters);
  void open_loop(const OWord& word, double rounds);
  void end_round(Construct& loop, bool has_another);

  const Listing* listing_;
  std::size_t next_ = 0;  // index of a line
  Nesting nesting_;
};

}  // namespace kcs::gcode
