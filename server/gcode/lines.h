// Cuts a stream of text, which comes in pieces cut anywhere, into lines.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "server/gcode/place.h"

namespace kcs::gcode {

// The longest line that is read, in bytes: what bounds the memory of a reader.
inline constexpr std::size_t kMaxLineLength = 65'536;

// A line ends with LF, CR LF or CR. A line that lies within one piece is not copied.
class Lines {
 public:
  // Calls use(std::string_view text, std::uint32_t number) for every line that `piece` completes, without its end.
  // The view is valid during the call only. Refuses a line longer than kMaxLineLength.
  template <typename Use>
  void read(std::string_view piece, Use&& use) {
    while (!piece.empty()) {
      if (skip_line_feed_ && piece.front() == '\n') piece.remove_prefix(1);
      skip_line_feed_ = false;
      const std::size_t length = length_of_line(piece);
      if (begun_.size() + length > kMaxLineLength) refuse_length();
      if (length == piece.size()) {
        begun_.append(piece);
        return;
      }
      skip_line_feed_ = piece[length] == '\r';
      if (begun_.empty()) {
        use(piece.substr(0, length), number_);
      } else {
        begun_.append(piece.substr(0, length));
        use(std::string_view(begun_), number_);
        begun_.clear();
      }
      ++number_;
      piece.remove_prefix(length + 1);
    }
  }

  // Calls use() for the last line if it has no end.
  template <typename Use>
  void finish(Use&& use) {
    if (!begun_.empty()) use(std::string_view(begun_), number_);
    begun_.clear();
  }

 private:
  static std::size_t length_of_line(std::string_view text) {
    std::size_t length = 0;
    while (length < text.size() && text[length] != '\n' && text[length] != '\r') ++length;
    return length;
  }

  [[noreturn]] void refuse_length() const {
    refuse({number_, 1}, "the line is longer than " + std::to_string(kMaxLineLength) +
                             " bytes. Is this a G-code program? If so, cut the line into shorter blocks.");
  }

  std::string begun_;  // the line that the last piece did not complete
  std::uint32_t number_ = 1;
  bool skip_line_feed_ = false;  // the last line ended with CR: a LF now belongs to its end
};

}  // namespace kcs::gcode
