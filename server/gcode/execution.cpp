#include "server/gcode/execution.h"

#include <optional>
#include <utility>

#include "server/gcode/arguments.h"
#include "server/gcode/cap_reached.h"
#include "server/gcode/dialect.h"

namespace kcs::gcode {
namespace {

constexpr std::size_t kBytesOfBlock = 32;  // longer lines count as several blocks, as they take longer to read

// Does what a line says. A refusal goes on to say if the line seems to be meant for another control.
template <typename Act>
void with_hint(const Line& line, Act&& act) {
  try {
    act();
  } catch (const CapReached&) {
    throw;
  } catch (const planning::InvalidInput& refusal) {
    const std::optional<std::string_view> hint = hint_on_dialect(line.text);
    if (!hint) throw;
    std::vector<planning::Violation> violations = refusal.violations();
    violations.front().description += " " + std::string(*hint);
    throw planning::InvalidInput(violations);
  }
}

}  // namespace

Execution::Execution(const Options& options, TakeSegment take, Notices& notices)
    : options_(options),
      notices_(notices),
      interpreter_(options, std::move(take), notices),
      parameters_(interpreter_, options.max_names) {}

void Execution::read(const Line& line) {
  if (program_.nesting().empty() && !begins_with_o_word(line.text)) {
    with_hint(line, [&] { execute(line); });
    return;
  }
  keep(line);
  run();
  if (program_.nesting().keeps_text()) return;
  listing_.clear();
  program_.restart();
}

void Execution::finish() {
  if (!has_ended() && !program_.nesting().empty()) {
    const Construct& open = program_.nesting().innermost();
    refuse(open.opened_by.place, open.opened_by.text() + " is not closed before the program ends. Add " +
                                     open.opened_by.text(open.end()) + ".");
  }
  interpreter_.finish();
}

void Execution::keep(const Line& line) {
  listing_.append(line);
  if (bytes_of_subroutines_ + listing_.bytes() <= options_.max_kept_bytes) return;
  throw CapReached({"max_kept_bytes", options_.max_kept_bytes}, {line.number, 1},
                   "the subroutines and the loop up to here take up more than " +
                       std::to_string(options_.max_kept_bytes) +
                       " bytes (the cap max_kept_bytes). Make them shorter, or write out the outermost loop.");
}

// Goes on where the program is, as far as its lines have come.
void Execution::run() {
  try {
    run_kept_lines();
  } catch (const CapReached& reached) {
    throw CapReached(reached.cap(), with_calls(reached.violations()));
  } catch (const planning::InvalidInput& refusal) {
    throw planning::InvalidInput(with_calls(refusal.violations()));
  }
}

void Execution::run_kept_lines() {
  while (!has_ended() && !walk().at_end()) {
    const Line line = walk().take();
    count(line);
    with_hint(line, [&] {
      if (begins_with_o_word(line.text)) {
        follow(line);
      } else if (walk().runs()) {
        execute(line);
      }
    });
  }
}

std::vector<planning::Violation> Execution::with_calls(std::vector<planning::Violation> violations) const {
  if (calls_.empty()) return violations;
  std::string& description = violations.front().description;
  description +=
      " This is in " + name_of(calls_.back().label) + ", called from line " + std::to_string(calls_.back().line);
  if (calls_.size() > 1) {
    description += ", and the main program is at its call in line " + std::to_string(calls_.front().line);
  }
  description += ".";
  return violations;
}

void Execution::count(const Line& line) {
  block_count_ += 1 + line.text.size() / kBytesOfBlock;
  if (block_count_ <= options_.max_blocks) return;
  throw CapReached({"max_blocks", options_.max_blocks}, {line.number, 1},
                   "subroutines, conditions and loops have run through more than " +
                       std::to_string(options_.max_blocks) +
                       " blocks (the cap max_blocks). Check that this loop ends, or split the program.");
}

void Execution::execute(const Line& line) {
  words_.read(line.text, line.number, parameters_);
  for (const Setting& setting : words_.settings()) parameters_.set(setting);
  has_begun_ = has_begun_ || words_.present() != 0 || !words_.codes().empty() || !words_.settings().empty();
  interpreter_.execute(words_);
}

// Executes a line with an O word.
void Execution::follow(const Line& line) {
  Cursor cursor(line.text, line.number);
  const OWord word = read_o_word(cursor);
  switch (word.keyword) {
    case Keyword::kNone:
      expect_no_argument(word, cursor);
      note_program_number(word);
      break;
    case Keyword::kSub:
      expect_no_argument(word, cursor);
      define(word);
      break;
    case Keyword::kEndSub:
      end_subroutine(word, cursor);
      break;
    case Keyword::kCall:
      if (walk().runs()) call(word, cursor);
      break;
    case Keyword::kReturn:
      if (walk().runs()) leave(word, cursor);
      break;
    default:
      walk().follow(word, cursor, parameters_);
      break;
  }
  has_begun_ = true;
}

void Execution::note_program_number(const OWord& word) {
  if (has_begun_) {
    refuse(word.place, word.text() +
                           " stands alone, which makes it a program number: that comes first in a program. Remove it, "
                           "or add what it was meant for, such as call or sub.");
  }
  notices_.add({'O'}, word.place.line, [&] { return "The program number (" + word.text() + ") has no effect."; });
}

void Execution::define(const OWord& word) {
  if (!program_.nesting().empty()) {
    const OWord& open = program_.nesting().innermost().opened_by;
    refuse(word.place, word.text() + " stands inside " + open.text() + " of line " + std::to_string(open.place.line) +
                           ". Close that first: a subroutine is defined outside of everything else.");
  }
  const auto found = subroutines_.find(word.label);
  if (found != subroutines_.end()) {
    refuse(word.place, name_of(word.label) + " is defined already, in line " + std::to_string(found->second[0].number) +
                           ". Choose another number or name.");
  }
  program_.open_subroutine(word);
}

void Execution::end_subroutine(const OWord& word, Cursor& cursor) {
  if (!calls_.empty()) {
    leave(word, cursor);
    return;
  }
  program_.close_subroutine(word);
  bytes_of_subroutines_ += listing_.bytes();
  subroutines_.emplace(word.label, std::exchange(listing_, {}));
  program_.restart();
}

void Execution::call(const OWord& word, Cursor& cursor) {
  const std::vector<double> arguments = arguments_of(word, cursor, parameters_);
  const auto subroutine = subroutines_.find(word.label);
  if (subroutine == subroutines_.end()) {
    refuse(word.place, name_of(word.label) + " is not defined before this call. Put " + word.text(Keyword::kSub) +
                           ", its lines and " + word.text(Keyword::kEndSub) +
                           " before it; a subroutine that lies in another file must be copied into the program.");
  }
  if (calls_.size() == kMaxCalls) {
    refuse(word.place, "more than " + std::to_string(kMaxCalls) +
                           " calls run inside one another. Check that the recursion ends, or use a loop.");
  }
  parameters_.enter(arguments);
  calls_.push_back({.label = word.label, .line = word.place.line, .walk = Walk(subroutine->second)});
  walk().take();  // the line of sub itself
}

// The end of a subroutine, or a return before it. LinuxCNC's own programs give a return the label of a condition, too.
void Execution::leave(const OWord& word, Cursor& cursor) {
  if (calls_.empty()) refuse(word.place, word.text() + " stands outside of every subroutine. Remove it.");
  parameters_.leave(optional_argument_of(word, cursor, parameters_));
  calls_.pop_back();
}

}  // namespace kcs::gcode
