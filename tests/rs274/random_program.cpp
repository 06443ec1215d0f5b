#include "tests/rs274/random_program.h"

#include <array>
#include <random>

namespace kcs::test {
namespace {

constexpr int kBlocks = 40;

class Writer {
 public:
  explicit Writer(std::uint32_t seed) : random_(seed) {}

  std::string program() {
    text_ = "G17 G90 G40 G80 F500\n";
    text_ += pick<2>({"G20\n", "G21\n"});
    text_ += "G0 Z" + number(10, 20) + "\n";
    for (int i = 0; i < kBlocks; ++i) block();
    return text_ + "M2\n";
  }

 private:
  template <std::size_t count>
  std::string pick(const std::array<const char*, count>& choices) {
    return choices[below(count)];
  }
  std::size_t below(std::size_t bound) { return random_() % bound; }

  // In steps of 1/64: neither side rounds sums of them.
  std::string number(int from, int to) {
    const auto steps = static_cast<std::size_t>(to - from) * 64;
    return std::to_string(from + static_cast<double>(below(steps + 1)) / 64);
  }
  std::string words(const std::string& letters, int from, int to) {
    std::string list;
    const std::size_t first = below(letters.size());
    for (std::size_t i = 0; i < letters.size(); ++i) {
      if (i == first || below(2) == 0) list += " " + std::string(1, letters[i]) + number(from, to);
    }
    return list;
  }

  void line(const std::string& block) { text_ += block + "\n"; }

  void block() {
    switch (below(12)) {
      case 0:
      case 1:
        line(pick<2>({"G0", "G1"}) + words("XYZ", -20, 20));
        break;
      case 2:
        arc();
        break;
      case 3:
        line("G1 @" + number(1, 10) + " ^" + number(-180, 180));
        break;
      case 4:
        line("G10 L" + pick<2>({"2", "20"}) + " P" + std::to_string(below(10)) + words("XYZ", -20, 20));
        break;
      case 5:
        // LinuxCNC loses the tool's position where G92 is in force.
        line("G92.1\nG10 L2 P" + std::to_string(below(10)) + " R" + number(-180, 180));
        break;
      case 6:
        line(pick<4>({"G54", "G55", "G59", "G59.3"}));
        break;
      case 7:
        line(pick<2>({"G92", "G52"}) + words("XYZ", -20, 20));
        break;
      case 8:
        line(pick<7>({"G92.1", "G92.2", "G92.3", "G49", "G91", "G90", "G28.1"}));
        break;
      case 9:
        line("G43.1" + words("XYZ", -20, 20));
        break;
      case 10:
        line("G90 G53 G0" + words("XYZ", -20, 20));
        break;
      default:
        drill();
        break;
    }
  }

  // A half or a whole circle, or a helix of some turns.
  void arc() {
    const std::string turn = pick<2>({"G2", "G3"});
    line("G91");
    const std::string diameter = number(1, 8);
    switch (below(3)) {
      case 0:
        line(turn + " X" + diameter + " I[" + diameter + "/2]" + words("Z", -5, 5) + " P" +
             std::to_string(1 + below(3)));
        break;
      case 1:
        line(turn + " Y" + diameter + " R" + pick<2>({"", "-"}) + "[" + diameter + "*0.75]");
        break;
      default:
        line(turn + " I" + number(1, 5) + " J" + number(-5, 5));
        break;
    }
    line("G90");
  }

  void drill() {
    line(pick<2>({"G98", "G99"}));
    const std::string where = below(4) == 0 ? "@" + number(1, 10) + " ^" + number(-180, 180) : words("XY", -20, 20);
    const std::string cycle = pick<4>({"G81", "G82 P1", "G85", "G89 P0.5"});
    const std::string peck = pick<2>({"G73", "G83"}) + " Q" + number(1, 3);
    if (below(2) == 0) {
      line((below(2) == 0 ? cycle : peck) + " " + where + " Z" + number(-10, 0) + " R" + number(1, 10));
    } else {
      line("G91 " + (below(2) == 0 ? cycle : peck) + " " + where + " Z" + number(-10, -1) + " R" + number(-5, 5) +
           " L" + std::to_string(1 + below(3)));
    }
    while (below(2) == 0) line(pick<3>({"", "G98", "G99"}) + words("XY", -5, 5));
    line("G90");
    if (below(2) == 0) line("G80");
  }

  std::mt19937 random_;
  std::string text_;
};

}  // namespace

std::string random_program(std::uint32_t seed) { return Writer(seed).program(); }

}  // namespace kcs::test
