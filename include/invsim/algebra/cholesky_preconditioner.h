// SPDX-License-Identifier: Apache-2.0
#ifndef INVSIM_ALGEBRA_CHOLESKY_PRECONDITIONER_H_
#define INVSIM_ALGEBRA_CHOLESKY_PRECONDITIONER_H_

// A Cholesky factorisation in single precision, for use where the residual is
// known in double precision, as in iterative refinement
//
//   x <- x + M^{-1} (b - A x),
//
// which gains about seven digits less those of A's condition at every turn.
// A single solve reads every entry of the factor twice and does little with it,
// so that half the memory is half the time; the factorisation is faster as
// well. The analysis is that of SparseCholesky.

#include <memory>

#include "invsim/algebra/block_matrix.h"

namespace invsim {

class CholeskyPreconditioner {
 public:
  explicit CholeskyPreconditioner(std::shared_ptr<const BlockPattern> pattern);
  ~CholeskyPreconditioner();
  CholeskyPreconditioner(CholeskyPreconditioner&&) noexcept;
  CholeskyPreconditioner& operator=(CholeskyPreconditioner&&) noexcept;

  // Only the lower triangle of `a` is read. False if `a` is not positive
  // definite in single precision (or not finite); then Solve may not be called.
  bool Factor(const BlockMatrix& a);

  // x <- M^{-1} x.
  void Solve(VectorXd* x) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace invsim

#endif  // INVSIM_ALGEBRA_CHOLESKY_PRECONDITIONER_H_
