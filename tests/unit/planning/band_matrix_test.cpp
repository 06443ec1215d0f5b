// Against the same equations with every entry.
#include "server/planning/band_matrix.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <random>

namespace kcs::planning {
namespace {

constexpr std::size_t kPoints = 40;
constexpr Eigen::Index kRows = 3 * kPoints;

// Sums of one to four points that begin at every point, with blocks over four decades, in a band matrix and in one with
// every entry.
struct Equations {
  explicit Equations(bool diagonal) {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> number(-1, 1);
    band.reset(kPoints);
    for (std::size_t first = 0; first < kPoints; ++first) {
      for (std::size_t count = 1; count <= std::min<std::size_t>(4, kPoints - first); ++count) {
        PointSum sum{first, count, {}};
        for (double& weight : sum.weights) weight = number(random);
        Eigen::Matrix3d block = Eigen::Matrix3d::Zero();
        if (diagonal) {
          const Eigen::Array3d entries = Eigen::Array3d(number(random), number(random), number(random)).square() + 0.01;
          block.diagonal() = entries;
          band.add(sum, entries);
        } else {
          const Eigen::Matrix3d root =
              std::exp(4 * number(random)) * Eigen::Matrix3d::NullaryExpr([&] { return number(random); });
          block = root * root.transpose();
          band.add(sum, block);
        }
        Eigen::MatrixXd map = Eigen::MatrixXd::Zero(3, kRows);
        for (std::size_t i = 0; i < count; ++i) {
          map.middleCols<3>(static_cast<Eigen::Index>(3 * (first + i))) = sum.weights[i] * Eigen::Matrix3d::Identity();
        }
        full += map.transpose() * block * map;
      }
    }
    for (Eigen::Index row = 0; row < kRows; ++row) right[row] = number(random);
  }

  std::vector<Vector> solved() const {
    std::vector<Vector> values;
    for (Eigen::Index row = 0; row < kRows; row += 3) values.emplace_back(right.segment<3>(row));
    band.solve(values);
    return values;
  }

  BandMatrix band;
  Eigen::MatrixXd full = Eigen::MatrixXd::Zero(kRows, kRows);
  Eigen::VectorXd right = Eigen::VectorXd::Zero(kRows);
};

void expect_equal(const std::vector<Vector>& values, const Eigen::VectorXd& expected) {
  const double largest = expected.cwiseAbs().maxCoeff();
  for (std::size_t i = 0; i < values.size(); ++i) {
    const Vector one = expected.segment<3>(static_cast<Eigen::Index>(3 * i));
    EXPECT_LT((values[i] - one).norm(), 1e-9 * largest) << i;
  }
}

class Band : public testing::TestWithParam<bool> {};

TEST_P(Band, IsSolvedAsWithEveryEntry) {
  Equations equations(GetParam());
  ASSERT_TRUE(equations.band.factorize());
  expect_equal(equations.solved(), equations.full.ldlt().solve(equations.right));
}

TEST_P(Band, LeavesWhatIsHeldAtZero) {
  Equations equations(GetParam());
  constexpr Eigen::Index kHeld = 17;
  equations.band.hold(kHeld);
  ASSERT_TRUE(equations.band.factorize());
  for (Eigen::Index row = 3 * kHeld; row < 3 * (kHeld + 1); ++row) {
    equations.full.row(row).setZero();
    equations.full.col(row).setZero();
    equations.full(row, row) = 1;
  }
  Eigen::VectorXd right = equations.right;
  right.segment<3>(3 * kHeld).setZero();
  const auto values = equations.solved();
  EXPECT_LT(values.at(kHeld).norm(), 1e-20);
  expect_equal(values, equations.full.ldlt().solve(right));
}

INSTANTIATE_TEST_SUITE_P(DiagonalBlocks, Band, testing::Bool());

TEST(BandMatrix, SaysThatItIsNotPositiveDefinite) {
  BandMatrix matrix;
  matrix.reset(3);
  matrix.add({0, 3, {1, -2, 1}}, Eigen::Array3d(1, 1, 1));
  EXPECT_FALSE(matrix.factorize());  // nothing holds the points themselves
}

}  // namespace
}  // namespace kcs::planning
