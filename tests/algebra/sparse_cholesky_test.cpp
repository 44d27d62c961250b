// SPDX-License-Identifier: Apache-2.0
#include "invsim/algebra/sparse_cholesky.h"

#include <gtest/gtest.h>

#include <limits>

#include "random_matrix.h"

namespace invsim {
namespace {

TEST(SparseCholesky, SolvesAndRefactors) {
  for (int n : {1, 2, 7, 20}) {
    SparseCholesky cholesky(GridPattern(n));
    for (unsigned seed : {1u, 2u}) {
      const BlockMatrix a = RandomMatrix(n, 0, seed);
      ASSERT_TRUE(cholesky.Factor(a));
      const Columns b = MatrixXd::Random(3 * a.size(), 5);
      Columns x = b, ax;
      cholesky.Solve(&x);
      a.Multiply(x, &ax);
      EXPECT_LT((ax - b).norm(), 1e-12 * b.norm());
      VectorXd y = b.col(0);
      cholesky.Solve(&y);
      EXPECT_LT((y - x.col(0)).norm(), 1e-12 * y.norm());
    }
  }
}

TEST(SparseCholesky, RefusesIndefiniteAndNotFinite) {
  BlockMatrix a = RandomMatrix(4, 0, 1);
  SparseCholesky cholesky(a.shared_pattern());
  a.diagonal(3)(1, 1) = -1;
  EXPECT_FALSE(cholesky.Factor(a));
  a.diagonal(3)(1, 1) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(cholesky.Factor(a));
  EXPECT_TRUE(cholesky.Factor(RandomMatrix(4, 0, 1)));
}

// A stiff triangle's matrix is singular along what does not stretch it, and
// rounding alone may make that negative. What is indefinite by more than
// rounding is refused.
TEST(SparseCholesky, WhatRoundingMadeIndefiniteIsShifted) {
  BlockMatrix a(GridPattern(2));
  for (int i = 0; i < 4; ++i) a.diagonal(i) = Matrix3d::Identity();
  SparseCholesky cholesky(a.shared_pattern());
  a.diagonal(2) = 1e8 * Matrix3d::Identity();
  a.diagonal(0)(0, 0) = -1e-7;
  ASSERT_TRUE(cholesky.Factor(a));
  VectorXd x = VectorXd::Ones(12);
  cholesky.Solve(&x);
  EXPECT_TRUE(x.allFinite());
  EXPECT_NEAR(x[1], 1, 1e-4);
  EXPECT_NEAR(x[6], 1e-8, 1e-18);
  a.diagonal(0)(0, 0) = -1e-3;
  EXPECT_FALSE(cholesky.Factor(a));
}

}  // namespace
}  // namespace invsim
