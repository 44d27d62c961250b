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

  // Of A + shift I.
  bool Factor(double shift) {
    cholmod_common* common = analysis.common();
    double beta[2] = {shift, 0};
    cholmod_factorize_p(
        analysis.lower(), beta, nullptr, 0, analysis.factor(), common);
    const bool ok = common->status == CHOLMOD_OK &&
                    analysis.factor()->minor == analysis.factor()->n;
    common->status = CHOLMOD_OK;
    return ok;
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
  if (!impl_->analysis.Load(a)) return false;
  if (impl_->Factor(0)) return true;
  double largest = 0;
  for (int i = 0; i < a.size(); ++i)
    largest = std::max(largest, a.diagonal(i).diagonal().maxCoeff());
  for (const double rounding : {1e-14, 1e-13, 1e-12})
    if (impl_->Factor(rounding * largest)) return true;
  return false;
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
