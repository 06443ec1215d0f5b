// Whether the path is travelled: what a distance to the path cannot show.

#include "server/motion/route.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "server/motion/verifier.h"
#include "tests/unit/motion/straight_moves.h"

namespace kcs::motion {
namespace {

class TravelTest : public testing::Test {
 protected:
  std::string fault() const {
    const std::size_t n = points_.size() - 1;
    const std::vector<double> feed(n, 1e4), tolerance(n, 0.01), reach(n, 0.01);
    std::vector<double> rest = rests_;
    rest.resize(n, -1);
    const Verification found = verify(moves_.trajectory(), {points_, feed, tolerance, reach, rest}, limits_);
    return found.fault;
  }

  AxisLimits limits_{2, Vector::Constant(1e4), Vector::Constant(1e5), Vector::Constant(1e4)};
  std::vector<Vector> points_;
  std::vector<double> rests_;
  StraightMoves moves_;
};

TEST_F(TravelTest, PassesWhatTravelsAllOfIt) {
  points_ = {{0, 0, 0}, {10, 0, 0}, {10, 10, 0}};
  moves_.go(points_[0], points_[1], {0, 0});
  moves_.go(points_[1], points_[2], {1, 1});
  EXPECT_EQ(fault(), "");
}

TEST_F(TravelTest, FindsASpikeThatIsLeftOut) {
  points_ = {{0, 0, 0}, {10, 0, 0}, {10, 50, 0}, {10, 0, 0}, {20, 0, 0}};
  moves_.go(points_[0], points_[1], {0, 0});
  moves_.go(points_[3], points_[4], {3, 3});
  EXPECT_NE(fault().find("left out"), std::string::npos) << fault();
}

TEST_F(TravelTest, FindsASpikeThatIsLeftOutUnderItsName) {
  points_ = {{0, 0, 0}, {10, 0, 0}, {10, 50, 0}, {10, 0, 0}, {20, 0, 0}};
  moves_.go(points_[0], points_[1], {0, 2});
  moves_.go(points_[3], points_[4], {2, 3});
  EXPECT_NE(fault().find("corner at (10, 50, 0)"), std::string::npos) << fault();
}

TEST_F(TravelTest, FindsAClosedPathThatIsNotTravelled) {
  points_ = {{0, 0, 0}, {10, 0, 0}, {10, 10, 0}, {0, 0, 0}};
  moves_.stand(7, points_[0], {0, 0});
  EXPECT_NE(fault().find("left out"), std::string::npos) << fault();
}

TEST_F(TravelTest, FindsAClosedPathTravelledTheOtherWayRound) {
  points_ = {{0, 0, 0}, {10, 0, 0}, {10, 10, 0}, {0, 0, 0}};
  moves_.go(points_[0], points_[2], {2, 2});
  moves_.go(points_[2], points_[1], {1, 1});
  moves_.go(points_[1], points_[0], {0, 0});
  EXPECT_NE(fault().find("out of order"), std::string::npos) << fault();
}

TEST_F(TravelTest, FindsAWayBackOnALine) {
  points_ = {{0, 0, 0}, {10, 0, 0}};
  moves_.go({0, 0, 0}, {8, 0, 0}, {0, 0});
  moves_.go({8, 0, 0}, {5, 0, 0}, {0, 0});
  moves_.go({5, 0, 0}, {10, 0, 0}, {0, 0});
  EXPECT_NE(fault().find("goes back"), std::string::npos) << fault();
}

// Whatever phases say of the segments that they follow.
TEST_F(TravelTest, FindsAWayBackOverSeveralLines) {
  points_ = {{0, 0, 0}, {5, 0, 0}, {10, 0.001, 0}, {15, 0.001, 0}};
  moves_.go({0, 0, 0}, {8, 0, 0}, {0, 1});
  moves_.go({8, 0, 0}, {6, 0, 0}, {0, 2});
  moves_.go({6, 0, 0}, {15, 0.001, 0}, {0, 2});
  EXPECT_NE(fault().find("goes back"), std::string::npos) << fault();
}

TEST_F(TravelTest, PassesAWayThereAndBackIfThatIsThePath) {
  points_ = {{0, 0, 0}, {8, 0, 0}, {6, 0, 0}, {6, 4, 0}};
  moves_.go({0, 0, 0}, {8, 0, 0}, {0, 1});
  moves_.go({8, 0, 0}, {6, 0, 0}, {0, 2});
  moves_.go({6, 0, 0}, {6, 4, 0}, {1, 2});
  EXPECT_EQ(fault(), "");
}

TEST_F(TravelTest, FindsARestThatIsLeftOutOrTooShort) {
  points_ = {{0, 0, 0}, {10, 0, 0}, {20, 0, 0}};
  rests_ = {0.5};
  moves_.go(points_[0], points_[1], {0, 0});
  moves_.stand(0.4, points_[1], {0, 0});
  const StraightMoves first_half = moves_;
  moves_.go(points_[1], points_[2], {1, 1});
  EXPECT_NE(fault().find("does not rest"), std::string::npos) << fault();
  moves_ = first_half;
  moves_.stand(0.1, points_[1], {0, 0});
  moves_.go(points_[1], points_[2], {1, 1});
  EXPECT_EQ(fault(), "");
}

TEST_F(TravelTest, FindsARestAtTheEndThatIsTooShort) {
  points_ = {{0, 0, 0}, {10, 0, 0}};
  rests_ = {0.5};
  moves_.go(points_[0], points_[1], {0, 0});
  moves_.stand(0.4, points_[1], {0, 0});
  EXPECT_NE(fault().find("does not rest"), std::string::npos) << fault();
  moves_.stand(0.1, points_[1], {0, 0});
  EXPECT_EQ(fault(), "");
}

TEST_F(TravelTest, FindsACornerThatOnlyOthersThanItsOwnPhasesPass) {
  // Down the first leg and up the third, which begins where the first one does: the second one's far end is left out.
  points_ = {{0, 0, 0}, {10, 0, 0}, {10, 3, 0}, {10, 0, 0}, {20, 0, 0}};
  moves_.go(points_[0], points_[1], {0, 0});
  moves_.go(points_[3], points_[4], {1, 3});
  EXPECT_NE(fault().find("corner at (10, 3, 0)"), std::string::npos) << fault();
}

}  // namespace
}  // namespace kcs::motion
