// SPDX-License-Identifier: Apache-2.0
#include "invsim/algebra/gmres.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace invsim {
namespace {

// One Givens rotation that turns (a, b) into (hypot, 0).
struct Rotation {
  double c = 1, s = 0;
  void Apply(double* a, double* b) const {
    const double t = c * *a + s * *b;
    *b = -s * *a + c * *b;
    *a = t;
  }
};

Rotation Annihilate(double a, double b) {
  const double length = std::hypot(a, b);
  return length > 0 ? Rotation{a / length, b / length} : Rotation{};
}

}  // namespace

GmresResult Gmres(const std::function<void(const VectorXd&, VectorXd*)>& apply,
                  const std::function<void(VectorXd*)>& precondition,
                  const VectorXd& b,
                  const GmresOptions& options,
                  VectorXd* x) {
  GmresResult result;
  x->setZero(b.size());
  const double norm_b = b.norm();
  if (norm_b == 0) {
    result.relative_residual = 0;
    return result;
  }
  const int m = options.restart;
  MatrixXd basis(b.size(), m + 1);
  MatrixXd h(m + 1, m);
  std::vector<Rotation> rotations(m);
  VectorXd residual = b, z(b.size()), w(b.size());
  double norm = norm_b;
  while (result.iterations < options.max_iterations) {
    VectorXd g = VectorXd::Zero(m + 1);
    g[0] = norm;
    basis.col(0) = residual / norm;
    int j = 0;
    while (j < m && result.iterations < options.max_iterations) {
      z = basis.col(j);
      precondition(&z);
      apply(z, &w);
      ++result.iterations;
      // Classical Gram-Schmidt, twice: as stable as the modified form.
      h.col(j).setZero();
      for (int pass = 0; pass < 2; ++pass) {
        const VectorXd c = basis.leftCols(j + 1).transpose() * w;
        w.noalias() -= basis.leftCols(j + 1) * c;
        h.col(j).head(j + 1) += c;
      }
      double next = w.norm();
      if (next > 0) basis.col(j + 1) = w / next;
      for (int k = 0; k < j; ++k) rotations[k].Apply(&h(k, j), &h(k + 1, j));
      rotations[j] = Annihilate(h(j, j), next);
      rotations[j].Apply(&h(j, j), &next);
      rotations[j].Apply(&g[j], &g[j + 1]);
      ++j;
      if (std::abs(g[j]) <= options.tolerance * norm_b) break;
    }
    const VectorXd y =
        h.topLeftCorner(j, j).triangularView<Eigen::Upper>().solve(g.head(j));
    z.noalias() = basis.leftCols(j) * y;
    precondition(&z);
    *x += z;
    result.relative_residual = std::abs(g[j]) / norm_b;
    if (result.relative_residual <= options.tolerance) break;
    apply(*x, &w);
    residual = b - w;
    norm = residual.norm();
    if (!std::isfinite(norm) || norm == 0) break;
  }
  return result;
}

}  // namespace invsim
