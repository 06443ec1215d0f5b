#include "server/gcode/reader.h"

#include <utility>

namespace kcs::gcode {
namespace {

constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";  // with which some editors begin UTF-8 text

}  // namespace

Reader::Reader(const Options& options, TakeSegment take) : execution_(options, std::move(take), notices_) {}

void Reader::read(std::string_view piece) {
  lines_.read(piece, [this](std::string_view text, std::uint32_t number) { read_line(text, number); });
}

void Reader::finish() {
  lines_.finish([this](std::string_view text, std::uint32_t number) { read_line(text, number); });
  execution_.finish();
}

void Reader::read_line(std::string_view text, std::uint32_t number) {
  if (number == 1 && text.starts_with(kByteOrderMark)) text.remove_prefix(kByteOrderMark.size());
  const std::size_t first = text.find_first_not_of(" \t");
  if (first == std::string_view::npos) return;
  if (has_ended_) {
    const bool has_words = std::string_view("%(;").find(text[first]) == std::string_view::npos;
    if (has_words) notices_.add({'%'}, number, [] { return "Lines after the program's end were not read."; });
  } else if (text[first] == '/') {
    notices_.add({'/'}, number, [] { return "Lines that begin with / were skipped, as with block delete on."; });
  } else if (text[first] == '%') {
    const std::size_t next = text.find_first_not_of(" \t", first + 1);
    if (next != std::string_view::npos && text[next] != '(' && text[next] != ';') {
      refuse({number, static_cast<std::uint32_t>(next + 1)}, "'%' must stand alone on its line. Remove the rest.");
    }
    has_ended_ = has_begun_ || execution_.has_begun();
    has_begun_ = true;
  } else {
    execution_.read({text, number});
    has_ended_ = execution_.has_ended();
  }
}

}  // namespace kcs::gcode
