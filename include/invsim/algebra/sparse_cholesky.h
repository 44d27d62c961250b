// SPDX-License-Identifier: Apache-2.0
#ifndef INVSIM_ALGEBRA_SPARSE_CHOLESKY_H_
#define INVSIM_ALGEBRA_SPARSE_CHOLESKY_H_

// Cholesky factorisation of a symmetric positive definite BlockMatrix
// (CHOLMOD, supernodal). The symbolic analysis is done once for a pattern,
// every Factor() is numeric only: "one factorisation" in the project's timings
// is one call of Factor().

#include <memory>

#include "invsim/algebra/block_matrix.h"

namespace invsim {

class SparseCholesky {
 public:
  explicit SparseCholesky(std::shared_ptr<const BlockPattern> pattern);
  ~SparseCholesky();
  SparseCholesky(SparseCholesky&&) noexcept;
  SparseCholesky& operator=(SparseCholesky&&) noexcept;

  // Only the lower triangle of `a` is read. What rounding alone has made
  // indefinite (slivers: entries ten orders apart) is factorised with as much
  // more on its diagonal as it takes, at most 1e-12 of the largest entry.
  // False if that does not help (or `a` is not finite); then Solve may not be
  // called.
  bool Factor(const BlockMatrix& a);

  // x <- A^{-1} x, one or many columns.
  void Solve(VectorXd* x) const;
  void Solve(Columns* x) const;

  // Non-zeros of the factor.
  double factor_nonzeros() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace invsim

#endif  // INVSIM_ALGEBRA_SPARSE_CHOLESKY_H_
