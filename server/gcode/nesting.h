// Which subroutines, conditions and loops a line of a program stands in.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "server/gcode/o_word.h"

namespace kcs::gcode {

// How deep they may stand inside one another, within the main program or one subroutine.
inline constexpr std::size_t kMaxNesting = 100;

// What happens to the lines inside one of them, in the round that it is in.
enum class Course : std::uint8_t {
  kRuns,       // they are executed
  kWaits,      // they are skipped up to an elseif or else: no part of the condition has run yet
  kContinues,  // they are skipped up to the end of the loop, where its next round is decided on
  kOver,       // they are skipped
};

// What lies between, say, while and endwhile.
struct Construct {
  OWord opened_by;
  Course course = Course::kOver;
  std::size_t start = 0;  // index of its first line, that of opened_by
  double rounds = 0;      // left for a repeat, this one included
  bool has_else = false;

  // What closes it.
  Keyword end() const;
  bool is_loop() const {
    return opened_by.keyword == Keyword::kWhile || opened_by.keyword == Keyword::kDo ||
           opened_by.keyword == Keyword::kRepeat;
  }
};

// From the outermost to the innermost.
class Nesting {
 public:
  bool empty() const { return open_.empty(); }
  // Not empty.
  const Construct& innermost() const { return open_.back(); }

  // Whether a line here is executed.
  bool runs() const { return open_.empty() || open_.back().course == Course::kRuns; }
  // Whether a line here will be needed again: it stands in a subroutine, or in a loop that may have another round.
  bool keeps_text() const;

  // Where lines are skipped, `course` must be kOver. Refuses one too many, and a label that is in use.
  Construct& open(const OWord& word, Course course, std::size_t start);
  // Whether `word` has the label of the innermost construct, which `opener` opened.
  bool is_innermost(const OWord& word, Keyword opener) const;
  // The innermost construct, to which `word` must belong. Refuses if `opener` did not open it with the same label.
  Construct& innermost_of(const OWord& word, Keyword opener);
  void close() { open_.pop_back(); }

  // From here on skips up to the end of the loop that has the label of `word`, break or continue. Refuses if this is
  // not in such a loop.
  void skip_to_end(const OWord& word, Course course);

 private:
  std::vector<Construct> open_;
};

}  // namespace kcs::gcode
