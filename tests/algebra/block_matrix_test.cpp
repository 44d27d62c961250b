// SPDX-License-Identifier: Apache-2.0
#include "invsim/algebra/block_matrix.h"

#include <gtest/gtest.h>

#include "random_matrix.h"

namespace invsim {
namespace {

TEST(BlockPattern, IsSymmetricWithDiagonal) {
  const auto p = GridPattern(5);
  for (int i = 0; i < p->size; ++i) {
    EXPECT_GE(p->Find(i, i), 0);
    for (int k = p->row_start[i]; k < p->row_start[i + 1]; ++k)
      EXPECT_GE(p->Find(p->column[k], i), 0);
  }
  EXPECT_EQ(p->Find(0, 24), -1);
}

TEST(BlockMatrix, ProductsEqualDense) {
  const BlockMatrix a = RandomMatrix(6, 1.0, 3);
  const MatrixXd dense = Dense(a);
  const Columns x = MatrixXd::Random(dense.rows(), 4);
  Columns y;
  a.Multiply(x, &y);
  EXPECT_LT((y - dense * x).norm(), 1e-12 * y.norm());
  a.MultiplyTransposed(x, &y);
  EXPECT_LT((y - dense.transpose() * x).norm(), 1e-12 * y.norm());
  const VectorXd v = x.col(0);
  EXPECT_LT((a * v - dense * v).norm(), 1e-12 * y.norm());
}

TEST(BlockMatrix, AssignsToAWiderPattern) {
  const BlockMatrix a = RandomMatrix(4, 0.5, 2);
  BlockPatternBuilder builder(a.pattern());
  const std::array<int, 3> stencil = {0, 7, 15};
  EXPECT_FALSE(a.pattern().Holds(stencil));
  builder.AddStencil(stencil);
  const auto wider = builder.Build();
  EXPECT_TRUE(wider->Holds(stencil));
  EXPECT_EQ(wider->num_blocks(), a.pattern().num_blocks() + 6);
  BlockMatrix b(wider);
  b.block(wider->Find(0, 15)).setOnes();
  b.Assign(a);
  EXPECT_EQ(Dense(b), Dense(a));
}

TEST(BlockMatrix, AddScaled) {
  BlockMatrix a = RandomMatrix(4, 0.0, 1);
  const BlockMatrix b = RandomMatrix(4, 0.5, 2);
  const MatrixXd sum = Dense(a) - 2.5 * Dense(b);
  a.AddScaled(-2.5, b);
  EXPECT_LT((Dense(a) - sum).norm(), 1e-13);
}

}  // namespace
}  // namespace invsim
