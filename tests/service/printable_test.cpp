#include "server/service/printable.h"

#include <gtest/gtest.h>

namespace kcs::service {
namespace {

TEST(Printable, KeepsText) {
  EXPECT_EQ(printable("feed, mm/s² — Fräse 刃 🙂", 100), "feed, mm/s² — Fräse 刃 🙂");
}

TEST(Printable, ReplacesWhatIsNoTextByteByByte) {
  EXPECT_EQ(printable("a\nb\tc\x7f", 100), "a?b?c?");
  EXPECT_EQ(printable("\xff\xc3.", 100), "??.");
  EXPECT_EQ(printable("\xe4\xb8", 100), "??");                 // cut short
  EXPECT_EQ(printable("\xc0\xaf\xe0\x80\xaf", 100), "?????");  // overlong
  EXPECT_EQ(printable("\xed\xa0\x80", 100), "???");            // half of a surrogate pair
  EXPECT_EQ(printable("\xf4\x90\x80\x80", 100), "????");       // beyond Unicode
}

TEST(Printable, CutsBetweenCharacters) {
  EXPECT_EQ(printable("abcdef", 3), "abc…");
  EXPECT_EQ(printable("ab²", 3), "ab…");
  EXPECT_EQ(printable("abc", 3), "abc");
}

}  // namespace
}  // namespace kcs::service
