// What the author of a program should know: what was read past or has no effect.
#pragma once

#include <cstdint>
#include <string>
#include <unordered_map>
#include <vector>

namespace kcs::gcode {

struct Notice {
  std::uint32_t line = 0;  // where it came up first, from 1
  std::string text;        // what was noticed, and what kcs did about it
  std::uint64_t count = 0;
};

// Collects notices, one for each kind, in the order in which the kinds came up first.
class Notices {
 public:
  // What makes two notices the same kind: a letter, and the number of a G or M word times ten where it matters.
  struct Kind {
    char letter;
    int tenths = 0;
  };

  // Counts one more of `kind`. text() gives its wording; it is called the first time only, so that counting is cheap.
  template <typename Text>
  void add(Kind kind, std::uint32_t line, Text&& text) {
    const auto [place, is_new] = index_.try_emplace(kind.letter * 100'000 + kind.tenths, list_.size());
    if (is_new) list_.push_back({line, text(), 0});
    ++list_[place->second].count;
  }

  const std::vector<Notice>& list() const { return list_; }

 private:
  std::unordered_map<int, std::size_t> index_;
  std::vector<Notice> list_;
};

}  // namespace kcs::gcode
