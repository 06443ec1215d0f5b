#include "server/gcode/walk.h"

#include <cmath>
#include <string>

#include "server/gcode/arguments.h"
#include "server/gcode/operators.h"

namespace kcs::gcode {
namespace {

double rounds_of(const OWord& word, Cursor& cursor, const Parameters& parameters) {
  cursor.skip_comments();
  const Place place = cursor.place();
  const double value = argument_of(word, cursor, parameters);
  const double whole = std::round(value);
  if (std::abs(value - whole) > kEqual) {
    refuse(place, word.text() + " takes a whole number, not " + std::to_string(value) + ". Use ROUND, FIX or FUP.");
  }
  return whole;
}

}  // namespace

void Walk::follow(const OWord& word, Cursor& cursor, const Parameters& parameters) {
  switch (word.keyword) {
    case Keyword::kDo:
      expect_no_argument(word, cursor);
      open_loop(word, 1);
      break;
    case Keyword::kRepeat:
      open_loop(word, runs() ? rounds_of(word, cursor, parameters) : 0);
      break;
    case Keyword::kEndRepeat: {
      expect_no_argument(word, cursor);
      Construct& loop = nesting_.innermost_of(word, Keyword::kRepeat);
      end_round(loop, loop.course != Course::kOver && --loop.rounds > 0);
      break;
    }
    case Keyword::kWhile:
      if (nesting_.is_innermost(word, Keyword::kDo)) {
        Construct& loop = nesting_.innermost_of(word, Keyword::kDo);
        end_round(loop, loop.course != Course::kOver && argument_of(word, cursor, parameters) != 0);
      } else {
        open_loop(word, runs() && argument_of(word, cursor, parameters) != 0 ? 1 : 0);
      }
      break;
    case Keyword::kEndWhile: {
      expect_no_argument(word, cursor);
      const Construct& loop = nesting_.innermost_of(word, Keyword::kWhile);
      if (loop.course != Course::kOver) next_ = loop.start;  // where the condition is read again
      nesting_.close();
      break;
    }
    case Keyword::kBreak:
    case Keyword::kContinue:
      expect_no_argument(word, cursor);
      if (runs()) nesting_.skip_to_end(word, word.keyword == Keyword::kBreak ? Course::kOver : Course::kContinues);
      break;
    default:
      follow_condition(word, cursor, parameters);
      break;
  }
}

void Walk::follow_condition(const OWord& word, Cursor& cursor, const Parameters& parameters) {
  const auto holds = [&] { return argument_of(word, cursor, parameters) != 0; };
  if (word.keyword == Keyword::kIf) {
    Course course = Course::kOver;
    if (runs()) course = holds() ? Course::kRuns : Course::kWaits;
    nesting_.open(word, course, next_ - 1);
    return;
  }
  if (word.keyword != Keyword::kElseIf) expect_no_argument(word, cursor);
  Construct& condition = nesting_.innermost_of(word, Keyword::kIf);
  if (word.keyword == Keyword::kEndIf) {
    nesting_.close();
    return;
  }
  if (condition.has_else) refuse(word.place, word.text() + " comes after else. Put it before that, or remove it.");
  condition.has_else = word.keyword == Keyword::kElse;
  if (condition.course == Course::kRuns) {
    condition.course = Course::kOver;
  } else if (condition.course == Course::kWaits && (condition.has_else || holds())) {
    condition.course = Course::kRuns;
  }
}

void Walk::open_loop(const OWord& word, double rounds) {
  nesting_.open(word, runs() && rounds > 0 ? Course::kRuns : Course::kOver, next_ - 1).rounds = rounds;
}

void Walk::end_round(Construct& loop, bool has_another) {
  if (has_another) {
    loop.course = Course::kRuns;
    next_ = loop.start + 1;
  } else {
    nesting_.close();
  }
}

void Walk::close_subroutine(const OWord& word) {
  nesting_.innermost_of(word, Keyword::kSub);
  nesting_.close();
}

}  // namespace kcs::gcode
