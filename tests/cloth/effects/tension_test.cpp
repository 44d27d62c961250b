// SPDX-License-Identifier: Apache-2.0
#include "invsim/cloth/effects/tension.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>

#include "../test_cloth.h"

namespace invsim {
namespace {

// The projection by an eigenvalue decomposition.
Vector3d ByEigenvalues(const Vector3d& s) {
  Matrix2d m;
  m << s[0], s[2], s[2], s[1];
  const Eigen::SelfAdjointEigenSolver<Matrix2d> eigen(m);
  const Matrix2d p = eigen.eigenvectors() *
                     eigen.eigenvalues().cwiseMax(0.0).asDiagonal() *
                     eigen.eigenvectors().transpose();
  return {p(0, 0), p(1, 1), p(0, 1)};
}

TEST(TensilePart, IsTheProjectionOntoTension) {
  const Points stresses = RandomPoints(200, 10.0, 5);
  int mixed = 0;
  for (int i = 0; i < stresses.cols(); ++i) {
    const Vector3d s = stresses.col(i);
    EXPECT_LE((TensilePart(s) - ByEigenvalues(s)).norm(), 1e-13 * s.norm());
    mixed += s[0] * s[1] < s[2] * s[2];
  }
  EXPECT_GT(mixed, 50);
}

TEST(TensilePart, DerivativeMatchesDifferences) {
  const Points stresses = RandomPoints(50, 10.0, 6);
  for (int i = 0; i < stresses.cols(); ++i) {
    const Vector3d s = stresses.col(i);
    Matrix3d derivative;
    TensilePart(s, &derivative);
    const MatrixXd expected =
        Jacobian([](const Points& p) { return TensilePart(p); }, s, 1e-4);
    EXPECT_LE((derivative - expected).norm(), 1e-9) << s.transpose();
  }
}

TEST(TensilePart, HandlesTheSpecialStresses) {
  Matrix3d derivative;
  EXPECT_EQ(TensilePart(Vector3d::Zero(), &derivative), Vector3d::Zero());
  EXPECT_TRUE(derivative.allFinite());
  EXPECT_EQ(TensilePart({3.0, 3.0, 0.0}), Vector3d(3.0, 3.0, 0.0));
  EXPECT_EQ(TensilePart({-3.0, -3.0, 0.0}), Vector3d::Zero());
  EXPECT_EQ(TensilePart({2.0, -1.0, 0.0}), Vector3d(2.0, 0.0, 0.0));
  // Pure shear: half of it is tension along the diagonal.
  EXPECT_LE((TensilePart({0.0, 0.0, 4.0}) - Vector3d(2.0, 2.0, 2.0)).norm(),
            1e-15);
}

}  // namespace
}  // namespace invsim
