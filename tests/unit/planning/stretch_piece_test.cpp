#include "server/planning/stretch_piece.h"

#include <gtest/gtest.h>

namespace kcs::planning {
namespace {

// So many points along X, at 1 mm/s; the motion begins at `way`, mm.
TimeSpline steady(double step, double way, int points) {
  TimeSpline spline{.step = step};
  for (int i = 0; i < points; ++i) {
    spline.ways.push_back(way + (i - 1) * step);
    spline.points.emplace_back(spline.ways.back(), 0, 0);
  }
  return spline;
}

// Over the step of the spline that goes on; that of the first is 1 s.
class StretchPieces : public testing::TestWithParam<double> {};

TEST_P(StretchPieces, GoOnInTimeAndPlaceWhateverTheStep) {
  std::vector<StretchPiece> pieces;
  append_pieces(steady(1, 0, 10), pieces);
  ASSERT_EQ(pieces.size(), 7u);
  append_pieces(steady(GetParam(), 7, 10), pieces);
  ASSERT_EQ(pieces.size(), 14u);
  EXPECT_EQ(pieces.front().phase.start_time, 0);
  EXPECT_NEAR(pieces.back().phase.end_time(), 7 + 7 * GetParam(), 1e-12);
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    const motion::Phase& phase = pieces[i].phase;
    EXPECT_NEAR(phase.start.position.x(), phase.start_time, 1e-12);
    EXPECT_NEAR(pieces[i].from, phase.start_time, 1e-12);
    EXPECT_NEAR(pieces[i].to, phase.end_time(), 1e-12);
  }
}

INSTANTIATE_TEST_SUITE_P(Steps, StretchPieces, testing::Values(0.3, 1, 3));

}  // namespace
}  // namespace kcs::planning
