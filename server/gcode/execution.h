// Executes the lines of a program in the order that its O words give them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <unordered_map>
#include <vector>

#include "server/gcode/interpreter.h"
#include "server/gcode/listing.h"
#include "server/gcode/notices.h"
#include "server/gcode/o_word.h"
#include "server/gcode/options.h"
#include "server/gcode/parameters.h"
#include "server/gcode/walk.h"
#include "server/gcode/words.h"
#include "server/planning/invalid_input.h"

namespace kcs::gcode {

// How many calls may run inside one another.
inline constexpr std::size_t kMaxCalls = 100;

// Lines are executed as they come. Kept are those only that may be needed again: subroutines, and the outermost loop
// of the main program, whose first round runs while its lines come.
class Execution {
 public:
  // `take` gets the moves, the last one at the end; `notices` must outlive the object.
  Execution(const Options& options, TakeSegment take, Notices& notices);
  // Its parts refer to each other.
  Execution(const Execution&) = delete;
  Execution& operator=(const Execution&) = delete;

  // Takes the next line of the program's text, and executes what can be executed now. Refuses what cannot be done,
  // naming the place and the call that led there; throws CapReached at a cap of the options.
  void read(const Line& line);
  // After the last line. Refuses what is begun and not closed.
  void finish();

  // Something other than comments came.
  bool has_begun() const { return has_begun_; }
  // M2 or M30 came.
  bool has_ended() const { return interpreter_.program_has_ended(); }

  // Largest distance between an arc and its chords so far, mm.
  double largest_chord_error() const { return interpreter_.largest_chord_error(); }

 private:
  // A call that is running.
  struct Call {
    std::string label;
    std::uint32_t line = 0;  // that calls
    Walk walk;               // through the subroutine
  };

  void keep(const Line& line);
  void run();
  void run_kept_lines();
  void count(const Line& line);
  void execute(const Line& line);
  void follow(const Line& line);
  void note_program_number(const OWord& word);
  void define(const OWord& word);
  void end_subroutine(const OWord& word, Cursor& cursor);
  void call(const OWord& word, Cursor& cursor);
  void leave(const OWord& word, Cursor& cursor);

  // Through the lines that are being executed.
  Walk& walk() { return calls_.empty() ? program_ : calls_.back().walk; }
  std::vector<planning::Violation> with_calls(std::vector<planning::Violation> violations) const;

  Options options_;
  Notices& notices_;
  Interpreter interpreter_;
  Parameters parameters_;
  Words words_;
  Listing listing_;  // of the main program's lines that may be needed again
  Walk program_{listing_};
  std::unordered_map<std::string, Listing> subroutines_;  // by label, from sub to endsub
  std::size_t bytes_of_subroutines_ = 0;
  std::vector<Call> calls_;  // the innermost one last
  std::size_t block_count_ = 0;
  bool has_begun_ = false;
};

}  // namespace kcs::gcode
