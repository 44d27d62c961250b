// SPDX-License-Identifier: Apache-2.0
#include "invsim/algebra/anderson.h"

#include <Eigen/Cholesky>
#include <algorithm>

namespace invsim {
namespace {

// Relative to the trace of the normal equations.
constexpr double kRegularization = 1e-12;
// |f| that grows by more is a sign of having gone astray.
constexpr double kGrowth = 2;

}  // namespace

void AndersonAcceleration::Reset() {
  count_ = 0;
  have_ = false;
}

void AndersonAcceleration::Remember(const VectorXd& f, const VectorXd& image) {
  if (df_.rows() != f.size() || df_.cols() != memory_) {
    df_.resize(f.size(), memory_);
    dt_.resize(f.size(), memory_);
    gram_.resize(memory_, memory_);
  }
  const int column = count_ % memory_;
  ++count_;
  df_.col(column) = f - last_f_;
  dt_.col(column) = image - last_image_;
  const int used = std::min(count_, memory_);
  gram_.col(column).head(used).noalias() =
      df_.leftCols(used).transpose() * df_.col(column);
  gram_.row(column).head(used) = gram_.col(column).head(used).transpose();
}

VectorXd AndersonAcceleration::Coefficients(const VectorXd& f) const {
  const int used = std::min(count_, memory_);
  MatrixXd normal = gram_.topLeftCorner(used, used);
  normal.diagonal().array() += kRegularization * normal.trace();
  return normal.ldlt().solve(df_.leftCols(used).transpose() * f);
}

void AndersonAcceleration::Next(const VectorXd& image, VectorXd* q) {
  const VectorXd f = image - *q;
  const double norm = f.norm();
  if (have_ && norm > kGrowth * norm_) {
    Reset();
    *q = last_image_;
    norm_ = norm;
    return;
  }
  if (have_) Remember(f, image);
  *q = image;
  if (count_ > 0)
    q->noalias() -= dt_.leftCols(std::min(count_, memory_)) * Coefficients(f);
  have_ = true;
  norm_ = norm;
  last_f_ = f;
  last_image_ = image;
}

}  // namespace invsim
