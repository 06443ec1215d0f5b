#include "server/planning/penalized_fit.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>

namespace kcs::planning {
namespace {

std::vector<Vector> wild_data(Eigen::Index size) {
  std::vector<Vector> data;
  for (Eigen::Index i = 0; i < size; ++i) {
    const auto t = static_cast<double>(i);
    data.emplace_back(std::sin(t), t, std::cos(3 * t));
  }
  return data;
}

// Over four decades, no two alike.
FitWeights wild_weights(Eigen::Index size) {
  FitWeights weights;
  for (Eigen::Index i = 0; i < size; ++i) {
    const auto t = static_cast<double>(i);
    weights.place.push_back(std::exp(4 * std::sin(2.3 * t)));
    weights.acceleration.push_back(std::exp(3 * std::cos(1.7 * t)));
    weights.jerk.emplace_back(std::exp(std::cos(t)), std::exp(std::cos(2 * t)), std::exp(std::sin(t)));
  }
  return weights;
}

// The normal equations of the same sum of squares for one axis, with every entry.
Eigen::VectorXd solved_densely(const FitWeights& weights, const std::vector<Vector>& data, Eigen::Index axis) {
  const auto size = static_cast<Eigen::Index>(data.size());
  Eigen::MatrixXd system = Eigen::MatrixXd::Zero(size, size);
  Eigen::VectorXd right = Eigen::VectorXd::Zero(size);
  const auto add = [&](Eigen::Index first, double weight, const Eigen::RowVectorXd& difference) {
    Eigen::RowVectorXd row = Eigen::RowVectorXd::Zero(size);
    row.segment(first, difference.size()) = difference;
    system += weight * row.transpose() * row;
  };
  for (Eigen::Index i = 0; i < size; ++i) {
    const auto index = static_cast<std::size_t>(i);
    system(i, i) += weights.place[index];
    right[i] = weights.place[index] * data[index][axis];
    if (i + 2 < size) add(i, weights.acceleration[index], Eigen::RowVector3d(1, -2, 1));
    if (i + 3 < size) add(i, weights.jerk[index][axis], Eigen::RowVector4d(-1, 3, -3, 1));
  }
  return system.ldlt().solve(right);
}

void expect_agreement(PenalizedFit& fit, const FitWeights& weights, bool alike, const std::vector<Vector>& data) {
  std::vector<Vector> found;
  fit.solve(weights, alike, data, found);
  ASSERT_EQ(found.size(), data.size());
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    const Eigen::VectorXd expected = solved_densely(weights, data, axis);
    for (std::size_t i = 0; i < found.size(); ++i) {
      EXPECT_NEAR(found[i][axis], expected[static_cast<Eigen::Index>(i)], 1e-9) << "point " << i << ", axis " << axis;
    }
  }
}

TEST(PenalizedFit, AgreesWithADenseSolver) {
  PenalizedFit fit;  // one for all: what the fit before left must not show
  for (const Eigen::Index size : {60, 4, 5, 9, 3}) {
    SCOPED_TRACE(size);
    FitWeights weights = wild_weights(size);
    expect_agreement(fit, weights, false, wild_data(size));
    for (Vector& jerk : weights.jerk) jerk.setConstant(jerk.x());
    expect_agreement(fit, weights, true, wild_data(size));
  }
}

TEST(PenalizedFit, AgreesWithADenseSolverWhereWeightsAreZero) {
  PenalizedFit fit;
  FitWeights weights = wild_weights(30);
  for (std::size_t i = 0; i < 30; ++i) {
    if (i % 4 != 1) weights.place[i] = 0;
    if (i % 3 == 0) weights.acceleration[i] = 0;
    if (i % 5 == 2) weights.jerk[i] = Vector::Zero();
  }
  expect_agreement(fit, weights, false, wild_data(30));
}

TEST(PenalizedFit, KeepsTheDataWhereNothingIsPenalized) {
  const std::vector<Vector> data = wild_data(20);
  const std::vector<double> none(20, 0.0);
  std::vector<Vector> found;
  PenalizedFit().solve({wild_weights(20).place, none, std::vector<Vector>(20, Vector::Zero())}, false, data, found);
  for (std::size_t i = 0; i < data.size(); ++i) EXPECT_LT((found[i] - data[i]).norm(), 1e-14) << i;
}

TEST(PenalizedFit, GoesThroughThreePointsWithoutJerk) {
  std::vector<Vector> data(20, Vector(1e3, -1e3, 5)), found;
  std::vector<double> place(20, 0.0);
  const auto parabola = [](double i) { return Vector(i * i, 3 - i, 7); };
  for (const std::size_t held : {2u, 9u, 16u}) {
    place[held] = 1;
    data[held] = parabola(static_cast<double>(held));
  }
  PenalizedFit().solve({place, std::vector(20, 0.0), std::vector<Vector>(20, Vector::Ones())}, true, data, found);
  for (std::size_t i = 0; i < data.size(); ++i) EXPECT_LT((found[i] - parabola(static_cast<double>(i))).norm(), 1e-6);
}

TEST(PenalizedFit, HoldsFirmlyWhatIsHeldFirmly) {
  FitWeights weights{std::vector(40, 1e-3), std::vector(40, 1.0), std::vector<Vector>(40, Vector::Ones())};
  weights.place[17] = 1e9;
  const std::vector<Vector> data = wild_data(40);
  std::vector<Vector> found;
  PenalizedFit().solve(weights, true, data, found);
  EXPECT_LT((found[17] - data[17]).norm(), 1e-8);
  EXPECT_GT((found[30] - data[30]).norm(), 0.1);
}

}  // namespace
}  // namespace kcs::planning
