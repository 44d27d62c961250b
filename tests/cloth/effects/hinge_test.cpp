// SPDX-License-Identifier: Apache-2.0
#include "invsim/cloth/effects/hinge.h"

#include <ceres/jet.h>
#include <gtest/gtest.h>

#include <numbers>

#include "../test_cloth.h"

namespace invsim {
namespace {

using Vertices = Hinge::Vertices;

// The angle by dual numbers, straight from the definition.
template <typename T>
T AngleOf(const Eigen::Matrix<T, 3, 4>& x) {
  const auto cross = [](const Eigen::Matrix<T, 3, 1>& a,
                        const Eigen::Matrix<T, 3, 1>& b) {
    return Eigen::Matrix<T, 3, 1>(a[1] * b[2] - a[2] * b[1],
                                  a[2] * b[0] - a[0] * b[2],
                                  a[0] * b[1] - a[1] * b[0]);
  };
  using std::atan2;
  using std::sqrt;
  const Eigen::Matrix<T, 3, 1> e = x.col(1) - x.col(0);
  const Eigen::Matrix<T, 3, 1> n2 = cross(e, x.col(2) - x.col(0));
  const Eigen::Matrix<T, 3, 1> n3 = cross(x.col(3) - x.col(0), e);
  return atan2(cross(n2, n3).dot(e) / sqrt(e.dot(e)), n2.dot(n3));
}

VectorXd GradientByDuals(const Points& points) {
  using Dual = ceres::Jet<double, 12>;
  Eigen::Matrix<Dual, 3, 4> x;
  for (int k = 0; k < 12; ++k) x.data()[k] = Dual(points.data()[k], k);
  return AngleOf(x).v;
}

Vertices Flat() {
  Vertices x;
  x << 0.0, 1.0, 0.4, 0.7, 0.0, 0.0, 1.1, -0.8, 0.0, 0.0, 0.0, 0.0;
  return x;
}

Hinge At(const Vertices& x) { return Hinge::At(x, 1.0, 0.5, 0.5); }

// The wing x2 turned about the edge by `angle`, away from the normals.
Vertices Bent(double angle) {
  Vertices x = Flat();
  x(2, 2) = -x(1, 2) * std::sin(angle);
  x(1, 2) *= std::cos(angle);
  return x;
}

TEST(Hinge, MeasuresTheAngle) {
  EXPECT_EQ(At(Flat()).angle, 0.0);
  for (const double angle : {1e-9, 0.3, -0.3, 1.5, -2.5, 3.1})
    EXPECT_NEAR(At(Bent(angle)).angle, angle, 1e-14);
}

TEST(Hinge, GradientIsThatOfTheAngle) {
  for (unsigned seed = 0; seed < 20; ++seed) {
    const Vertices x = Bent(0.3 * seed - 3.0) + RandomPoints(4, 0.2, seed);
    const VectorXd expected = GradientByDuals(x);
    const Hinge hinge = At(x);
    EXPECT_LE((hinge.gradient.reshaped() - expected).norm(),
              1e-12 * expected.norm());
  }
}

TEST(Hinge, SlopeIsTheHessianAndSymmetric) {
  for (unsigned seed = 0; seed < 20; ++seed) {
    const Vertices x = Bent(0.3 * seed - 3.0) + RandomPoints(4, 0.2, seed);
    const Hinge::Slope slope = Hinge::GradientSlope(x, 1.0, 0.5, 0.5);
    const MatrixXd expected = Jacobian(GradientByDuals, x, 1e-3);
    EXPECT_LE((slope - expected).norm(), 1e-9 * expected.norm());
    EXPECT_LE((slope - slope.transpose()).norm(), 1e-13 * slope.norm());
  }
}

TEST(Hinge, GradientIsFiniteAtAFlatFold) {
  const Hinge hinge = At(Bent(std::numbers::pi));
  EXPECT_NEAR(std::abs(hinge.angle), std::numbers::pi, 1e-12);
  EXPECT_TRUE(hinge.gradient.allFinite());
}

// Wings of no area and edges of no length: bounded, continuous, and the slope
// is that of the bounded gradient.
TEST(Hinge, IsBoundedWhenCollapsed) {
  for (int kind = 0; kind < 4; ++kind) {
    Vertices x = Bent(0.4);
    if (kind == 0) x.col(2) = 0.5 * (x.col(0) + x.col(1));
    if (kind == 1) x.col(3) = x.col(1) + Vector3d(0.0, 1e-3, 0.0);
    if (kind == 2) x.col(1) = x.col(0);
    if (kind == 3) x.setZero();
    const Hinge hinge = At(x);
    EXPECT_TRUE(std::isfinite(hinge.angle));
    EXPECT_TRUE(hinge.gradient.allFinite());
    EXPECT_LE(hinge.gradient.norm(), 1e4);
    const Hinge::Slope slope = Hinge::GradientSlope(x, 1.0, 0.5, 0.5);
    EXPECT_TRUE(slope.allFinite());
    const MatrixXd expected = Jacobian(
        [](const Points& p) -> VectorXd { return At(p).gradient.reshaped(); },
        x,
        1e-6);
    EXPECT_LE((slope - expected).norm(), 1e-6 * expected.norm() + 1e-9) << kind;
  }
}

TEST(Hinge, TurnsBeyondTheBoundAsTheAngleDoes) {
  Vertices x = Bent(0.4);
  EXPECT_FALSE(At(x).collapsed);
  EXPECT_EQ(Hinge::AngleGradient(x), At(x).gradient);
  x.col(2) = 0.004 * x.col(2) + 0.5 * (x.col(0) + x.col(1));  // a thin wing
  EXPECT_TRUE(At(x).collapsed);
  const VectorXd expected = GradientByDuals(x);
  EXPECT_GT(expected.norm(), 2 * At(x).gradient.norm());
  EXPECT_LE((Hinge::AngleGradient(x).reshaped() - expected).norm(),
            1e-12 * expected.norm());
  x = Bent(0.4);
  x.col(1) = 0.004 * x.col(1);  // a short edge
  EXPECT_TRUE(At(x).collapsed);
  EXPECT_NEAR(At(x).angle, AngleOf(x), 1e-12);
  EXPECT_LE((Hinge::AngleGradient(x).reshaped() - GradientByDuals(x)).norm(),
            1e-12 * GradientByDuals(x).norm());
  x.col(2) = x.col(0);
  EXPECT_TRUE(Hinge::AngleGradient(x).allFinite());
}

TEST(Hinge, IsContinuousWhereTheBoundSetsIn) {
  Vertices x = Flat();
  const auto gradient = [&](double height) {
    x(1, 2) = height;
    return At(x).gradient;
  };
  const double border = kCollapse;  // |N| = |e| height, rest 1
  EXPECT_LE(
      (gradient(border * (1 + 1e-9)) - gradient(border * (1 - 1e-9))).norm(),
      1e-5 * gradient(border).norm());
}

}  // namespace
}  // namespace invsim
