// Text that no CAM program would write: it is refused or read, and a path that comes out is sound.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "tests/unit/gcode/program.h"

namespace kcs::gcode {
namespace {

constexpr std::string_view kSeed =
    "%\n(part)\nN10 G17 G20 G90 G94 G54\nG0 Z0.25 T1 M6\nX-0.5 Y0. S1000 M3\nG01 Z0. F5.\nG02 X0. Y0.5 I0.5 J0. F2.5\n"
    "X0.5 Y0. I0. J-0.5\nG21 G61\nG3 X20 Y5 R50 Z3\nG18 G2 X30 Z13 I10 K0\nG93 G1 X1 F30\nG94 F100\nG91 X2 E5\nG92 X0\n"
    "G61.1 G64 P.1\nG4 P1\nG53 G0 X0\nM84\nM30\n%\n";

bool is_sound(const Program& program) {
  for (const planning::Segment& segment : program.segments()) {
    const bool sound = segment.end.allFinite() && segment.end.cwiseAbs().maxCoeff() <= 2e7 && segment.feed > 0 &&
                       segment.tolerance >= 0 && segment.tolerance <= 1000 && segment.dwell >= 0 &&
                       (segment.stop || segment.dwell == 0) && segment.line > 0;
    if (!sound) return false;
  }
  return std::isfinite(program.chord_error);
}

// Reads or refuses; false if what comes out is neither.
bool survives(const std::string& text) {
  Options options;
  options.max_segments = 20'000;
  try {
    return is_sound(read_program(text, options));
  } catch (const planning::InvalidInput& refusal) {
    return refusal.violations().size() == 1 && refusal.violations()[0].field.starts_with("gcode, line ") &&
           !refusal.violations()[0].description.empty();
  }
}

TEST(Hostile, ChangedBytesAreReadOrRefused) {
  std::mt19937_64 random(42);
  for (int round = 0; round < 20'000; ++round) {
    std::string text(kSeed);
    const std::size_t changes = 1 + random() % 8;
    for (std::size_t change = 0; change < changes; ++change) {
      const std::size_t place = random() % text.size();
      switch (random() % 3) {
        case 0:
          text[place] = static_cast<char>(random());
          break;
        case 1:
          text.erase(place, random() % 5);
          break;
        default:
          text.insert(place, 1, static_cast<char>(random() % 128));
          break;
      }
    }
    ASSERT_TRUE(survives(text)) << "round " << round << ":\n" << text;
  }
}

TEST(Hostile, ShuffledWordsAreReadOrRefused) {
  constexpr std::string_view kWords[] = {"G0",  "G1",  "G2",  "G3",    "G4",           "G17",       "G18",     "G19",
                                         "G20", "G21", "G43", "G53",   "G54",          "G61",       "G61.1",   "G64",
                                         "G80", "G90", "G91", "G90.1", "G91.1",        "G92",       "G92.1",   "G92.3",
                                         "G93", "G94", "X1",  "X-2.5", "Y0",           "Y3",        "Z-1",     "Z.5",
                                         "I1",  "I-1", "J2",  "K-.5",  "R1",           "R-3",       "P1",      "P2",
                                         "F60", "F0",  "S5",  "T1",    "M0",           "M6",        "M3",      "M30",
                                         "M84", "E1",  "A0",  "N5",    "X99999999999", "F.0000001", "R999999", "I0",
                                         "J0",  "X0",  "(c)", ";c",    "\r\n",         "/",         "%",       "\n"};
  std::mt19937_64 random(43);
  std::size_t accepted = 0;
  for (int round = 0; round < 20'000; ++round) {
    std::string text = "F600\n";
    const std::size_t count = random() % 12;
    for (std::size_t word = 0; word < count; ++word) {
      text += kWords[random() % std::size(kWords)];
      text += random() % 3 == 0 ? "\n" : " ";
    }
    ASSERT_TRUE(survives(text)) << "round " << round << ":\n" << text;
    accepted += refusal_of(text).empty() ? 1 : 0;
  }
  EXPECT_GT(accepted, 1000U);  // else the test reads error messages only
}

}  // namespace
}  // namespace kcs::gcode
