// SPDX-License-Identifier: Apache-2.0
#include "invsim/algebra/sparse_cholesky.h"

#include <algorithm>
#include <utility>

#include "cholmod_analysis.h"

namespace invsim {

struct SparseCholesky::Impl {
  explicit Impl(std::shared_ptr<const BlockPattern> pattern)
      : analysis(std::move(pattern)) {}
  ~Impl() {
    cholmod_free_dense(&x, analysis.common());
    cholmod_free_dense(&y, analysis.common());
    cholmod_free_dense(&e, analysis.common());
  }

  void Solve(double* data, int columns) {
    const int n = 3 * analysis.pattern().size;
    cholmod_dense b{};
    b.nrow = b.d = n;
    b.ncol = columns;
    b.nzmax = static_cast<size_t>(n) * columns;
    b.x = data;
    b.xtype = CHOLMOD_REAL;
    b.dtype = CHOLMOD_DOUBLE;
    cholmod_solve2(CHOLMOD_A,
                   analysis.factor(),
                   &b,
                   nullptr,
                   &x,
                   nullptr,
                   &y,
                   &e,
                   analysis.common());
    const double* from = static_cast<const double*>(x->x);
    std::copy(from, from + b.nzmax, data);
  }

  CholmodAnalysis analysis;
  cholmod_dense* x = nullptr;  // workspaces kept between solves
  cholmod_dense* y = nullptr;
  cholmod_dense* e = nullptr;
};

SparseCholesky::SparseCholesky(std::shared_ptr<const BlockPattern> pattern)
    : impl_(std::make_unique<Impl>(std::move(pattern))) {}
SparseCholesky::~SparseCholesky() = default;
SparseCholesky::SparseCholesky(SparseCholesky&&) noexcept = default;
SparseCholesky& SparseCholesky::operator=(SparseCholesky&&) noexcept = default;

bool SparseCholesky::Factor(const BlockMatrix& a) {
  CholmodAnalysis& s = impl_->analysis;
  if (!s.Load(a)) return false;
  cholmod_factorize(s.lower(), s.factor(), s.common());
  const bool ok =
      s.common()->status == CHOLMOD_OK && s.factor()->minor == s.factor()->n;
  s.common()->status = CHOLMOD_OK;
  return ok;
}

void SparseCholesky::Solve(VectorXd* x) const { impl_->Solve(x->data(), 1); }

void SparseCholesky::Solve(Columns* x) const {
  if (x->cols() == 0) return;
  MatrixXd columns = *x;
  impl_->Solve(columns.data(), static_cast<int>(columns.cols()));
  *x = columns;
}

double SparseCholesky::factor_nonzeros() const {
  return static_cast<double>(impl_->analysis.factor()->xsize);
}

}  // namespace invsim
