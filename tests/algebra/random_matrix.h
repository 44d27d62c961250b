// SPDX-License-Identifier: Apache-2.0
#ifndef INVSIM_TESTS_ALGEBRA_RANDOM_MATRIX_H_
#define INVSIM_TESTS_ALGEBRA_RANDOM_MATRIX_H_

#include <random>
#include <vector>

#include "invsim/algebra/block_matrix.h"

namespace invsim {

// The pattern of a triangulated square of n x n vertices.
inline std::shared_ptr<const BlockPattern> GridPattern(int n) {
  BlockPatternBuilder builder(n * n);
  for (int i = 0; i + 1 < n; ++i) {
    for (int j = 0; j + 1 < n; ++j) {
      const int a = i * n + j;
      builder.AddStencil(std::vector<int>{a, a + 1, a + n, a + n + 1});
    }
  }
  return builder.Build();
}

// Symmetric, diagonally dominant, hence positive definite; `skew` adds an
// unsymmetric part of that relative size.
inline BlockMatrix RandomMatrix(int n, double skew, unsigned seed) {
  BlockMatrix a(GridPattern(n));
  const BlockPattern& p = a.pattern();
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform(-1, 1);
  for (int i = 0; i < p.size; ++i) {
    for (int k = p.row_start[i]; k < p.row_start[i + 1]; ++k) {
      const int j = p.column[k];
      if (j < i) continue;
      Matrix3d block;
      for (double& x : block.reshaped()) x = uniform(random);
      if (i == j) {
        a.block(k) = block + block.transpose() + 40 * Matrix3d::Identity();
      } else {
        a.block(k) = block;
        a.block(p.Find(j, i)) = block.transpose();
      }
    }
  }
  for (int k = 0; k < p.num_blocks(); ++k)
    for (double& x : a.block(k).reshaped()) x += skew * uniform(random);
  return a;
}

inline MatrixXd Dense(const BlockMatrix& a) {
  const BlockPattern& p = a.pattern();
  MatrixXd d = MatrixXd::Zero(3 * p.size, 3 * p.size);
  for (int i = 0; i < p.size; ++i)
    for (int k = p.row_start[i]; k < p.row_start[i + 1]; ++k)
      d.block<3, 3>(3 * i, 3 * p.column[k]) = a.block(k);
  return d;
}

}  // namespace invsim

#endif  // INVSIM_TESTS_ALGEBRA_RANDOM_MATRIX_H_
