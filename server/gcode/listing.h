// Lines of a program that are kept to be executed again.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace kcs::gcode {

struct Line {
  std::string_view text;
  std::uint32_t number = 0;  // in the program, from 1
};

class Listing {
 public:
  void append(const Line& line) {
    text_ += line.text;
    lines_.push_back({text_.size(), line.number});
  }
  void clear() {
    text_.clear();
    lines_.clear();
  }

  std::size_t size() const { return lines_.size(); }
  // Valid until the listing changes.
  Line operator[](std::size_t index) const {
    const std::size_t begin = index == 0 ? 0 : lines_[index - 1].end;
    return {std::string_view(text_).substr(begin, lines_[index].end - begin), lines_[index].number};
  }

  // What the lines take up in memory.
  std::size_t bytes() const { return text_.size() + lines_.size() * sizeof(End); }

 private:
  struct End {
    std::size_t end;  // of the line, in text_
    std::uint32_t number;
  };

  std::string text_;
  std::vector<End> lines_;
};

}  // namespace kcs::gcode
