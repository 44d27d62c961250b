// SPDX-License-Identifier: Apache-2.0
#include "invsim/cloth/effects/stretch_law.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>

#include "../test_cloth.h"

namespace invsim {
namespace {

TEST(StretchLaw, IsotropicIsPlaneStress) {
  const StretchLaw law(IsotropicStretch{100.0, 0.25});
  EXPECT_TRUE(law.linear());
  const Matrix3d c = StretchLaw::Matrix(law.At(Vector3d(0.1, -0.2, 0.3)));
  // A pull along 1 with S22 = 0: E22 = -nu E11, S11 = Y E11.
  const Vector3d pull = c * Vector3d(0.01, -0.0025, 0.0);
  EXPECT_NEAR(pull[0], 1.0, 1e-14);
  EXPECT_NEAR(pull[1], 0.0, 1e-14);
  // Shear modulus Y / (2 (1 + nu)).
  EXPECT_NEAR((c * Vector3d(0.0, 0.0, 0.01))[2], 0.4, 1e-14);
}

TEST(StretchLaw, OrthotropicFromEngineeringConstants) {
  const StretchLaw law(FromEngineeringConstants(300.0, 600.0, 25.0, 0.2));
  const Matrix3d c = StretchLaw::Matrix(law.At(Vector3d::Zero()));
  const Vector3d along_1 = c.inverse() * Vector3d(300.0, 0.0, 0.0);
  EXPECT_NEAR(along_1[0], 1.0, 1e-14);
  EXPECT_NEAR(along_1[1], -0.2, 1e-14);
  const Vector3d along_2 = c.inverse() * Vector3d(0.0, 600.0, 0.0);
  EXPECT_NEAR(along_2[1], 1.0, 1e-14);
  EXPECT_NEAR(c(2, 2), 25.0, 0.0);
}

// Worked by hand at points of the grid.
TEST(StretchLaw, MeasuredAtAPullAlongAxis1) {
  const StretchLaw law(ExampleStretchTable());
  EXPECT_FALSE(law.linear());
  // E11 = 0.15: stretch sqrt(1.3) = 1.140175, weight 0.841052, angle 0:
  // row 0 (20, -5, 35, 30) and row 1 (45, 50, 250, 20).
  const auto c = law.At(Vector3d(0.15, -1.0 / 60.0, 0.0));
  EXPECT_NEAR(c[0], 2.0 * (20.0 + 0.8410525 * 25.0), 1e-4);
  EXPECT_NEAR(c[1], 2.0 * (-5.0 + 0.8410525 * 55.0), 1e-4);
  EXPECT_NEAR(c[2], 2.0 * (35.0 + 0.8410525 * 215.0), 1e-4);
  EXPECT_NEAR(c[3], 30.0 - 0.8410525 * 10.0, 1e-4);
}

TEST(StretchLaw, MeasuredAtAPullAlongTheDiagonal) {
  const StretchLaw law(ExampleStretchTable());
  // E11 = E22 = 1/12, E12 = 0.1: the larger eigenvalue of 2 E + I is
  // 1 + 1/6 + 0.2, the stretch 1.169045, so the weight is 1, angle 45 degrees.
  for (const double sign : {1.0, -1.0}) {
    const auto c = law.At(Vector3d(1 / 12., 1 / 12., sign * 0.2));
    EXPECT_NEAR(c[0], 240.0, 1e-9);
    EXPECT_NEAR(c[1], 200.0, 1e-9);
    EXPECT_NEAR(c[2], 720.0, 1e-9);
    EXPECT_NEAR(c[3], 40.0, 1e-9);
  }
}

TEST(StretchLaw, MeasuredBetweenDirectionsAndBelowZero) {
  const StretchLaw law(ExampleStretchTable());
  // E22 = 0.55 alone: weight 1, 90 degrees, the last row.
  EXPECT_NEAR(law.At(Vector3d(-1 / 60., 0.55, 0.0))[2], 800.0, 1e-9);
  // At 67.5 degrees the table has c33 = -15, which counts as zero:
  // tan(2 phi) = -1 where E12 = (E22 - E11) / 2.
  const auto c = law.At(Vector3d(1 / 12., 1 / 12. + 0.4, 0.4));
  EXPECT_NEAR(c[0], 280.0, 1e-9);
  EXPECT_EQ(c[3], 0.0);
}

TEST(StretchLaw, MeasuredStaysAsAtTheBorderBeyondTheGrid) {
  const StretchLaw law(ExampleStretchTable());
  StretchLaw::ConstantsGradient gradient;
  const auto far = law.At(Vector3d(3.0, 0.0, 0.0), &gradient);
  EXPECT_EQ(far, law.At(Vector3d(2.0, 0.0, 0.0)));
  EXPECT_EQ(gradient.col(0).norm(), 0.0);
}

TEST(StretchLaw, MeasuredIsPositiveSemidefiniteAndDifferentiable) {
  MeasuredStretch fabric = ExampleStretchTable();
  fabric.table[3][1] = 900.0;  // would give energy away
  const StretchLaw law(fabric);
  const Points strains = RandomPoints(300, 0.4, 9);
  for (int i = 0; i < strains.cols(); ++i) {
    const Vector3d e = strains.col(i);
    StretchLaw::ConstantsGradient gradient;
    const Matrix3d c = StretchLaw::Matrix(law.At(e, &gradient));
    const Eigen::SelfAdjointEigenSolver<Matrix3d> eigen(c);
    EXPECT_GE(eigen.eigenvalues().minCoeff(), -1e-10);
    const MatrixXd expected =
        Jacobian([&](const Points& p) { return law.At(p); }, e, 1e-6);
    EXPECT_LE((gradient - expected).norm(), 1e-6 * (1.0 + expected.norm()))
        << e.transpose();
  }
}

}  // namespace
}  // namespace invsim
