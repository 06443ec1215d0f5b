#include "server/gcode/nesting.h"

#include <algorithm>
#include <string>

namespace kcs::gcode {

Keyword Construct::end() const {
  switch (opened_by.keyword) {
    case Keyword::kSub:
      return Keyword::kEndSub;
    case Keyword::kIf:
      return Keyword::kEndIf;
    case Keyword::kDo:
      return Keyword::kWhile;
    case Keyword::kRepeat:
      return Keyword::kEndRepeat;
    default:
      return Keyword::kEndWhile;
  }
}

bool Nesting::keeps_text() const {
  return std::any_of(open_.begin(), open_.end(), [](const Construct& construct) {
    return construct.opened_by.keyword == Keyword::kSub || (construct.is_loop() && construct.course != Course::kOver);
  });
}

Construct& Nesting::open(const OWord& word, Course course, std::size_t start) {
  if (open_.size() == kMaxNesting) {
    refuse(word.place, "conditions and loops stand more than " + std::to_string(kMaxNesting) +
                           " deep inside one another. Put the inner ones into a subroutine.");
  }
  const auto same = std::find_if(open_.begin(), open_.end(), [&](const Construct& construct) {
    return construct.opened_by.label == word.label && construct.opened_by.keyword != Keyword::kSub;
  });
  if (same != open_.end()) {
    const OWord& open = same->opened_by;
    refuse(word.place, word.text() + " stands inside " + open.text() + " of line " + std::to_string(open.place.line) +
                           ". Close what is open in that first, or choose another number or name.");
  }
  return open_.emplace_back(Construct{.opened_by = word, .course = course, .start = start});
}

bool Nesting::is_innermost(const OWord& word, Keyword opener) const {
  return !open_.empty() && open_.back().opened_by.keyword == opener && open_.back().opened_by.label == word.label;
}

Construct& Nesting::innermost_of(const OWord& word, Keyword opener) {
  if (is_innermost(word, opener)) return open_.back();
  const std::string missing = word.text() + " has no " + word.text(opener) + " before it";
  if (open_.empty()) refuse(word.place, missing + ". Add that, or remove this line.");
  const OWord& open = open_.back().opened_by;
  refuse(word.place, missing + ": " + open.text() + " of line " + std::to_string(open.place.line) +
                         " is open here. Close that first, and check the labels.");
}

void Nesting::skip_to_end(const OWord& word, Course course) {
  const auto loop = std::find_if(open_.rbegin(), open_.rend(), [&](const Construct& construct) {
    return construct.is_loop() && construct.opened_by.label == word.label;
  });
  if (loop == open_.rend()) {
    refuse(word.place, word.text() + " stands in no loop with its label. Give it the label of the loop that it ends.");
  }
  for (auto inner = open_.rbegin(); inner != loop; ++inner) inner->course = Course::kOver;
  loop->course = course;
}

}  // namespace kcs::gcode
