// SPDX-License-Identifier: Apache-2.0
#include "invsim/algebra/gmres.h"

#include <gtest/gtest.h>

#include "invsim/algebra/sparse_cholesky.h"
#include "random_matrix.h"

namespace invsim {
namespace {

TEST(Gmres, SolvesWithAndWithoutRestart) {
  const BlockMatrix a = RandomMatrix(8, 2.0, 5);
  const VectorXd b = VectorXd::Random(3 * a.size());
  for (int restart : {5, 200}) {
    GmresOptions options;
    options.tolerance = 1e-11;
    options.restart = restart;
    options.max_iterations = 500;
    VectorXd x;
    const GmresResult result =
        Gmres([&](const VectorXd& z, VectorXd* out) { *out = a * z; },
              [](VectorXd*) {},
              b,
              options,
              &x);
    EXPECT_LT((a * x - b).norm(), 2e-11 * b.norm());
    EXPECT_LE(result.relative_residual, 1e-11);
  }
}

TEST(Gmres, ExactPreconditionerNeedsOneIteration) {
  const BlockMatrix a = RandomMatrix(8, 0, 5);
  SparseCholesky cholesky(a.shared_pattern());
  ASSERT_TRUE(cholesky.Factor(a));
  const VectorXd b = VectorXd::Random(3 * a.size());
  VectorXd x;
  const GmresResult result =
      Gmres([&](const VectorXd& z, VectorXd* out) { *out = a * z; },
            [&](VectorXd* z) { cholesky.Solve(z); },
            b,
            {},
            &x);
  EXPECT_EQ(result.iterations, 1);
  EXPECT_LT((a * x - b).norm(), 1e-10 * b.norm());
}

TEST(Gmres, ZeroRightSide) {
  VectorXd x = VectorXd::Ones(3);
  const GmresResult result = Gmres([](const VectorXd&, VectorXd*) {},
                                   [](VectorXd*) {},
                                   VectorXd::Zero(3),
                                   {},
                                   &x);
  EXPECT_EQ(result.iterations, 0);
  EXPECT_EQ(x.norm(), 0);
}

}  // namespace
}  // namespace invsim
