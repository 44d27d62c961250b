// SPDX-License-Identifier: Apache-2.0
#ifndef INVSIM_CONTACT_FRICTION_SOLVER_H_
#define INVSIM_CONTACT_FRICTION_SOLVER_H_

// The frictional problem of one sub-step: find v and contact forces r with
//
//   A v = b + sum_i G_i^T r_i,     Phi(r_i, G_i v - w_i + c_i r_i) = 0,
//
// A symmetric positive definite, G_i v the weighted velocity of contact i.
// On a vertex with one exact contact r is eliminated, r = (A v - b) there, so
// no contact unknown enters the matrix.
//
// Method. P = A + sum rho_i G_i^T G_i is factorised in single precision, rho_i
// a part of the vertex's own diagonal of A along the normal and across it.
// Douglas-Rachford splitting (ADMM) with P and closed-form local Coulomb
// projections, under Anderson acceleration, converges to the solution: one
// factorisation and some tens of single solves. What the contacts do is known
// long before their forces are; if it would still take many iterations then,
// rho is fitted to it (what is closed firm, what slides as stiff as friction
// is) and P factorised once more. If splitting does not converge within its
// share of iterations, semismooth
// Newton on the Alart-Curnier form goes on from the best iterate: its Jacobian
// is factorised once, and while few contacts change their mode GMRES with that
// factor solves the later iterations. If Newton stagnates (it may cycle between
// modes), splitting goes on with another rho, twice as long, and Newton is
// tried again; what is left is reported.

#include <memory>
#include <vector>

#include "invsim/algebra/block_matrix.h"
#include "invsim/contact/contact.h"
#include "invsim/contact/coulomb.h"

namespace invsim {

struct FrictionOptions {
  // |Phi| of every contact and the momentum of every free vertex, in units of
  // the vertex's weight.
  double tolerance = 1e-6;
  // Splitting iterations, at most, before Newton. Each costs one solve.
  int admm_iterations = 100;
  // Newton iterations before splitting is asked again, and how often it is.
  int newton_iterations = 30;
  int retries = 3;
  // Relative linear residual at which GMRES is done, and the iterations after
  // which the Jacobian is factorised anew instead.
  double krylov_tolerance = 1e-2;
  int krylov_iterations = 12;
};

struct FrictionStats {
  bool converged = false;
  bool factorization_failed = false;
  double residual = 0;  // see FrictionOptions::tolerance
  int factorizations = 0;
  int solves = 0;  // triangular solves with one right side
  int admm_iterations = 0;
  int newton_iterations = 0;
  int open = 0, stick = 0, slide = 0;
  double factor_seconds = 0;
  double solve_seconds = 0;
};

struct FrictionProblem {
  const BlockMatrix* a;
  const VectorXd* b;                     // N
  const std::vector<Contact>* contacts;  // at most one exact one on a vertex
  const VectorXd* weight;                // N per vertex, the unit of residuals
};

class FrictionSolver {
 public:
  // `pattern` of A. Contacts may couple vertices that it does not.
  explicit FrictionSolver(std::shared_ptr<const BlockPattern> pattern);
  ~FrictionSolver();

  // `v` and `forces` (one per contact, N) are the start and the result.
  FrictionStats Solve(const FrictionProblem& problem,
                      const FrictionOptions& options,
                      VectorXd* v,
                      std::vector<Vector3d>* forces);

  // Forgets which contacts there were, of which only the pattern of the
  // factorised matrix remains (contact/contact_pattern.h).
  void Forget();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace invsim

#endif  // INVSIM_CONTACT_FRICTION_SOLVER_H_
