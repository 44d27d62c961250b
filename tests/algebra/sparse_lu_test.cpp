// SPDX-License-Identifier: Apache-2.0
#include "invsim/algebra/sparse_lu.h"

#include <gtest/gtest.h>

#include "random_matrix.h"

namespace invsim {
namespace {

TEST(SparseLu, SolvesUnsymmetricBothWays) {
  for (int n : {1, 2, 7, 20}) {
    SparseLu lu(GridPattern(n));
    for (unsigned seed : {1u, 2u}) {
      const BlockMatrix a = RandomMatrix(n, 3.0, seed);
      ASSERT_TRUE(lu.Factor(a));
      const Columns b = MatrixXd::Random(3 * a.size(), 5);
      Columns x = b, ax;
      lu.Solve(&x);
      a.Multiply(x, &ax);
      EXPECT_LT((ax - b).norm(), 1e-11 * b.norm());
      x = b;
      lu.SolveTransposed(&x);
      a.MultiplyTransposed(x, &ax);
      EXPECT_LT((ax - b).norm(), 1e-11 * b.norm());
    }
  }
}

TEST(SparseLu, ExchangesRowsWithinABlock) {
  BlockMatrix a = RandomMatrix(3, 0, 1);
  SparseLu lu(a.shared_pattern());
  // A diagonal block that no elimination without row exchange survives.
  a.diagonal(4) << 0, 30, 0, 0, 0, 30, 30, 0, 0;
  ASSERT_TRUE(lu.Factor(a));
  const Columns b = MatrixXd::Random(27, 2);
  Columns x = b, ax;
  lu.Solve(&x);
  a.Multiply(x, &ax);
  EXPECT_LT((ax - b).norm(), 1e-11);
}

TEST(SparseLu, RefusesSingular) {
  BlockMatrix a = RandomMatrix(3, 0, 1);
  SparseLu lu(a.shared_pattern());
  for (int k = a.pattern().row_start[2]; k < a.pattern().row_start[3]; ++k) {
    a.block(k).setZero();
    a.block(a.pattern().Find(a.pattern().column[k], 2)).setZero();
  }
  EXPECT_FALSE(lu.Factor(a));
}

}  // namespace
}  // namespace invsim
