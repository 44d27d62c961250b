// SPDX-License-Identifier: Apache-2.0
#include "invsim/algebra/anderson.h"

#include <gtest/gtest.h>

#include <array>
#include <cstdlib>

namespace invsim {
namespace {

// A symmetric map with known eigenvalues and fixed point.
struct LinearMap {
  explicit LinearMap(const VectorXd& eigenvalues) {
    std::srand(3);
    const Eigen::Index n = eigenvalues.size();
    const VectorXd axis = VectorXd::Random(n).normalized();
    const MatrixXd turn =
        MatrixXd::Identity(n, n) - 2 * axis * axis.transpose();
    matrix = turn * eigenvalues.asDiagonal() * turn;
    fixed_point = VectorXd::Random(n);
  }
  VectorXd operator()(const VectorXd& q) const {
    return fixed_point + matrix * (q - fixed_point);
  }
  MatrixXd matrix;
  VectorXd fixed_point;
};

TEST(AndersonAcceleration, EndsALinearMapInAsManyStepsAsItHasEigenvalues) {
  VectorXd eigenvalues(30);
  for (int i = 0; i < 30; ++i)
    eigenvalues[i] = std::array{0.99, 0.7, -0.9, 0.2}[i % 4];
  const LinearMap map(eigenvalues);
  AndersonAcceleration anderson(10);
  VectorXd q = VectorXd::Zero(30);
  for (int it = 0; it < 6; ++it) anderson.Next(map(q), &q);
  EXPECT_LT((q - map.fixed_point).norm(), 1e-8);
}

TEST(AndersonAcceleration, IsMuchFasterThanTheMapWithAShortMemory) {
  const LinearMap map(VectorXd::LinSpaced(200, -0.5, 0.999));
  AndersonAcceleration anderson(5);
  VectorXd plain = VectorXd::Zero(200), q = plain;
  for (int it = 0; it < 100; ++it) {
    plain = map(plain);
    anderson.Next(map(q), &q);
  }
  EXPECT_LT((map(q) - q).norm(), 0.1 * (map(plain) - plain).norm());
}

// |q| has slopes of both signs: an extrapolation across the kink overshoots.
TEST(AndersonAcceleration, FindsTheFixedPointOfAPiecewiseLinearMap) {
  const LinearMap map(VectorXd::LinSpaced(40, -0.95, 0.98));
  const auto kinked = [&](const VectorXd& q) {
    return VectorXd(0.5 * (map(q) + q.cwiseAbs()));
  };
  AndersonAcceleration anderson(8);
  VectorXd q = 10 * VectorXd::Random(40);
  for (int it = 0; it < 300; ++it) anderson.Next(kinked(q), &q);
  EXPECT_LT((kinked(q) - q).norm(), 1e-10);
}

}  // namespace
}  // namespace invsim
