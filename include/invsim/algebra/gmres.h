// SPDX-License-Identifier: Apache-2.0
#ifndef INVSIM_ALGEBRA_GMRES_H_
#define INVSIM_ALGEBRA_GMRES_H_

// Restarted GMRES (Saad & Schultz 1986) with a right preconditioner, matrix
// free: finds x with |b - J x| <= tolerance |b|, where x = M^{-1} y.

#include <functional>

#include "invsim/base/types.h"

namespace invsim {

struct GmresOptions {
  double tolerance = 1e-6;   // relative to |b|
  int max_iterations = 200;  // products with J in all
  int restart = 50;          // basis vectors kept
};

struct GmresResult {
  int iterations = 0;
  double relative_residual = 1;  // estimated by the recurrence
};

// `apply(z, out)`: out = J z. `precondition(z)`: z <- M^{-1} z. Starts at
// x = 0 and overwrites *x.
GmresResult Gmres(const std::function<void(const VectorXd&, VectorXd*)>& apply,
                  const std::function<void(VectorXd*)>& precondition,
                  const VectorXd& b,
                  const GmresOptions& options,
                  VectorXd* x);

}  // namespace invsim

#endif  // INVSIM_ALGEBRA_GMRES_H_
