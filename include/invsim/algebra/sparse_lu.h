// SPDX-License-Identifier: Apache-2.0
#ifndef INVSIM_ALGEBRA_SPARSE_LU_H_
#define INVSIM_ALGEBRA_SPARSE_LU_H_

// LU factorisation of an unsymmetric BlockMatrix whose pattern is symmetric
// and whose values are not far from a positive definite matrix: the Jacobian
// of a frictional step, in which friction makes the contact rows unsymmetric.
//
// It runs left-looking over the supernodes of CHOLMOD's symbolic Cholesky
// analysis, with the dense kernels of a supernodal method, so that it costs
// twice the arithmetic of Cholesky and solves many right sides at the same
// speed. (UMFPACK and KLU, which do not use the symmetry of the pattern, are
// several times slower here; docs/performance.md.) Rows are exchanged only
// within a supernode's diagonal block; `backward_error` tells whether that
// sufficed.

#include <memory>

#include "invsim/algebra/block_matrix.h"

namespace invsim {

class SparseLu {
 public:
  explicit SparseLu(std::shared_ptr<const BlockPattern> pattern);
  ~SparseLu();
  SparseLu(SparseLu&&) noexcept;
  SparseLu& operator=(SparseLu&&) noexcept;

  // False if a pivot is zero or not finite.
  bool Factor(const BlockMatrix& a);

  // x <- A^{-1} x and x <- A^{-T} x, one or many columns.
  void Solve(Columns* x) const;
  void SolveTransposed(Columns* x) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace invsim

#endif  // INVSIM_ALGEBRA_SPARSE_LU_H_
