#include "server/motion/course.h"

#include <gtest/gtest.h>

namespace kcs::motion {
namespace {

PathSegment to(double x, double y, double feed = 10, double rest = -1) {
  return {.end = {x, y, 0}, .feed = feed, .rest = rest};
}

TEST(Course, JoinsWhatIsOnALineAndAgrees) {
  Course course(Vector::Zero());
  for (const PathSegment& segment : {to(1, 0), to(2, 0), to(3, 0, 20), to(3, 1, 20)}) course.add(segment);
  ASSERT_EQ(course.pieces(), 3u);
  EXPECT_EQ(course.piece(0).line.to(), Vector(2, 0, 0));
  EXPECT_EQ(course.pieces_of({1, 3}).first, 0u);
  EXPECT_EQ(course.pieces_of({1, 3}).last, 2u);
}

TEST(Course, BreaksWhereTheToolRests) {
  Course course(Vector::Zero());
  course.add(to(1, 0, 10, 0));
  course.add(to(2, 0));
  EXPECT_EQ(course.pieces(), 2u);
}

TEST(Course, SettlesAPieceWhenTheNextOneBegins) {
  Course course(Vector::Zero());
  course.add(to(1, 0));
  course.add(to(2, 0));
  EXPECT_EQ(course.settled_segments(), 0u);
  course.add(to(2, 1));
  EXPECT_EQ(course.settled_segments(), 2u);
}

TEST(Course, FindsItsPiecesByTheirNumbersAfterForgetting) {
  Course course(Vector::Zero());
  for (int i = 0; i < 1000; ++i) {
    const int column = i / 2 + 1, row = i % 2;
    course.add(to(column, row));
    const std::uint32_t last = course.pieces() - 1;
    EXPECT_EQ(course.piece(last).line.to(), course.end());
    EXPECT_EQ(course.pieces_of({last, last}).first, last);
    if (last >= 3) course.forget_before(last - 2);
    EXPECT_EQ(course.part({course.first_piece(), last}).size(), last >= 3 ? 3u : last + 1);
    EXPECT_EQ(course.part({course.first_piece(), last}).back().line.to(), course.end());
  }
}

}  // namespace
}  // namespace kcs::motion
