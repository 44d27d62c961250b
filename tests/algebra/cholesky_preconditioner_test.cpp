// SPDX-License-Identifier: Apache-2.0
#include "invsim/algebra/cholesky_preconditioner.h"

#include <gtest/gtest.h>

#include <limits>

#include "random_matrix.h"

namespace invsim {
namespace {

TEST(CholeskyPreconditioner, SolvesToSinglePrecisionAndRefinesToDouble) {
  for (int n : {1, 2, 7, 20}) {
    CholeskyPreconditioner cholesky(GridPattern(n));
    for (unsigned seed : {1u, 2u}) {
      const BlockMatrix a = RandomMatrix(n, 0, seed);
      ASSERT_TRUE(cholesky.Factor(a));
      const VectorXd b = VectorXd::Random(3 * a.size());
      VectorXd x = b;
      cholesky.Solve(&x);
      EXPECT_LT((a * x - b).norm(), 1e-5 * b.norm());
      for (int turn = 0; turn < 2; ++turn) {
        VectorXd correction = b - a * x;
        cholesky.Solve(&correction);
        x += correction;
      }
      EXPECT_LT((a * x - b).norm(), 1e-14 * b.norm());
    }
  }
}

TEST(CholeskyPreconditioner, RefusesIndefiniteAndNotFinite) {
  BlockMatrix a = RandomMatrix(3, 0, 1);
  CholeskyPreconditioner cholesky(a.shared_pattern());
  a.diagonal(4) *= -1;
  EXPECT_FALSE(cholesky.Factor(a));
  a.diagonal(4)(0, 0) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(cholesky.Factor(a));
}

}  // namespace
}  // namespace invsim
