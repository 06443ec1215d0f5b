// Which line of the program each segment of a path comes from.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>

namespace kcs::motion {

// Where the lines are evenly spaced, as those of an arc's chords (one line) or of a curve in short moves (a line each),
// segments share an entry: 6 bytes a segment at worst. Those that are no longer needed can be forgotten.
class ProgramLines {
 public:
  // The next segment comes from this line, counted from 1; 0: not known.
  void add(std::uint32_t line);

  // The line of a segment, counted from 0, that was added and not forgotten; 0: not known. Time: logarithmic.
  std::uint32_t of(std::uint32_t segment) const;

  // Forgets the segments before `segment`, which is at most as many as were added.
  void forget_before(std::uint32_t segment);

  std::size_t bytes() const { return runs_.size() * sizeof(Run); }  // of memory

 private:
  // Segments up to the next run.
  struct Run {
    std::uint32_t first, line;  // of the first one
    std::uint32_t step;         // from a segment's line to that of the next one, modulo 2^32

    std::uint32_t line_of(std::uint32_t segment) const { return line + (segment - first) * step; }
  };

  std::deque<Run> runs_;
  std::uint32_t segments_ = 0;  // that were added
};

}  // namespace kcs::motion
