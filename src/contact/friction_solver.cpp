// SPDX-License-Identifier: Apache-2.0
#include "invsim/contact/friction_solver.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "invsim/algebra/gmres.h"
#include "invsim/algebra/sparse_cholesky.h"
#include "invsim/base/stopwatch.h"
#include "invsim/contact/friction_jacobian.h"

namespace invsim {
namespace {

// Newton has stagnated if its residual did not halve in so many iterations.
constexpr int kPatience = 3;

}  // namespace

struct FrictionSolver::Impl {
  explicit Impl(std::shared_ptr<const BlockPattern> p)
      : pattern(p), cholesky(p), augmented(p), jacobian(p) {}

  void Prepare();
  bool Factor();
  void PreconditionedSolve(VectorXd* z);
  void Admm(int iterations);
  double Evaluate();
  void ApplyJacobian(const VectorXd& z, VectorXd* out) const;
  bool NewtonStep(bool factored, VectorXd* step);
  bool Newton();
  void CountModes();

  std::shared_ptr<const BlockPattern> pattern;
  SparseCholesky cholesky;
  BlockMatrix augmented;  // P
  FrictionJacobian jacobian;

  FrictionProblem problem;
  FrictionOptions options;
  FrictionStats stats;
  VectorXd v;
  std::vector<Vector3d> forces;
  std::vector<double> rho;
  std::vector<int> exact_on;  // per vertex: its exact contact, or -1

  // At the current v: g = A v - b - compliant forces, and the linearisation.
  VectorXd g;
  VectorXd residual;
  std::vector<ContactLinearization> exact;     // of exact contacts
  std::vector<CompliantDerivative> compliant;  // of the others
};

FrictionSolver::FrictionSolver(std::shared_ptr<const BlockPattern> pattern)
    : impl_(std::make_unique<Impl>(std::move(pattern))) {}
FrictionSolver::~FrictionSolver() = default;

void FrictionSolver::Impl::Prepare() {
  const auto& contacts = *problem.contacts;
  rho.resize(contacts.size());
  exact_on.assign(pattern->size, -1);
  for (size_t k = 0; k < contacts.size(); ++k) {
    const Contact& c = contacts[k];
    double delassus = 0;
    for (int j = 0; j < c.num_vertices; ++j)
      delassus += c.weight[j] * c.weight[j] * 3 /
                  problem.a->diagonal(c.vertex[j]).trace();
    rho[k] = 1 / (delassus + c.compliance);
    if (c.exact()) exact_on[c.vertex[0]] = static_cast<int>(k);
  }
  exact.resize(contacts.size());
  compliant.resize(contacts.size());
}

bool FrictionSolver::Impl::Factor() {
  augmented = *problem.a;
  for (size_t k = 0; k < rho.size(); ++k) {
    const Contact& c = (*problem.contacts)[k];
    for (int i = 0; i < c.num_vertices; ++i)
      for (int j = 0; j < c.num_vertices; ++j)
        augmented.block(pattern->Find(c.vertex[i], c.vertex[j]))
            .diagonal()
            .array() += rho[k] * c.weight[i] * c.weight[j];
  }
  const Stopwatch watch;
  const bool ok = cholesky.Factor(augmented);
  stats.factor_seconds += watch.seconds();
  ++stats.factorizations;
  stats.factorization_failed = !ok;
  return ok;
}

void FrictionSolver::Impl::PreconditionedSolve(VectorXd* z) {
  cholesky.Solve(z);
  ++stats.solves;
}

// min 1/2 v^T A v - b^T v with the contact law on z = G v - w, multipliers the
// contact forces. With r fixed, v = P^{-1} (b + sum G^T (rho (z + w) + r));
// then z and the new r follow from u = q + r/rho with q = G v - w - r_old/rho.
void FrictionSolver::Impl::Admm(int iterations) {
  const auto& contacts = *problem.contacts;
  std::vector<Vector3d> z(contacts.size());
  for (size_t k = 0; k < contacts.size(); ++k)
    z[k] = contacts[k].Gather(v) - contacts[k].velocity;
  for (int it = 0; it < iterations; ++it) {
    v = *problem.b;
    for (size_t k = 0; k < contacts.size(); ++k) {
      const Contact& c = contacts[k];
      c.Scatter(rho[k] * (z[k] + c.velocity) + forces[k], &v);
    }
    PreconditionedSolve(&v);
    ++stats.admm_iterations;
    for (size_t k = 0; k < contacts.size(); ++k) {
      const Contact& c = contacts[k];
      const Vector3d q = c.Gather(v) - c.velocity - forces[k] / rho[k];
      forces[k] = c.kind == ContactKind::kPin
                      ? Vector3d(-rho[k] * q)
                      : CompliantForce(
                            c.normal, c.friction, 1 / rho[k] + c.compliance, q);
      z[k] = q + forces[k] / rho[k];
    }
  }
}

// Fills g, residual and the linearisations; returns the reported residual.
double FrictionSolver::Impl::Evaluate() {
  const auto& contacts = *problem.contacts;
  const VectorXd& weight = *problem.weight;
  g = *problem.a * v - *problem.b;
  for (size_t k = 0; k < contacts.size(); ++k) {
    const Contact& c = contacts[k];
    if (c.exact()) continue;
    const Vector3d q = c.Gather(v) - c.velocity;
    forces[k] = CompliantForce(c.normal, c.friction, c.compliance, q);
    compliant[k] =
        DifferentiateCompliantForce(c.normal, c.friction, c.compliance, q);
    c.Scatter(-forces[k], &g);
  }
  residual = g;
  double worst = 0;
  for (int i = 0; i < pattern->size; ++i) {
    const int k = exact_on[i];
    double error;
    if (k < 0) {
      error = g.segment<3>(3 * i).norm();
    } else {
      const Contact& c = contacts[k];
      const Vector3d r = g.segment<3>(3 * i);
      const Vector3d u = v.segment<3>(3 * i) - c.velocity;
      forces[k] = r;
      if (c.kind == ContactKind::kPin) {
        exact[k] = {ContactMode::kStick,
                    Matrix3d::Zero(),
                    rho[k] * Matrix3d::Identity(),
                    rho[k] * u,
                    Matrix3d::Zero()};
        error = rho[k] * u.norm();
      } else {
        exact[k] = LinearizeAlartCurnier(c.normal, c.friction, rho[k], r, u);
        error = FischerBurmeister(c.normal, c.friction, rho[k], r, u).norm();
      }
      residual.segment<3>(3 * i) = exact[k].residual;
    }
    worst = std::max(worst, error / weight[i]);
    if (!std::isfinite(error)) return std::numeric_limits<double>::infinity();
  }
  return worst;
}

void FrictionSolver::Impl::ApplyJacobian(const VectorXd& z,
                                         VectorXd* out) const {
  const auto& contacts = *problem.contacts;
  *out = *problem.a * z;
  for (size_t k = 0; k < contacts.size(); ++k)
    if (!contacts[k].exact())
      contacts[k].Scatter(-(compliant[k].dq * contacts[k].Gather(z)), out);
  for (size_t k = 0; k < contacts.size(); ++k) {
    if (!contacts[k].exact()) continue;
    const int i = contacts[k].vertex[0];
    const Vector3d dr = out->segment<3>(3 * i);
    out->segment<3>(3 * i) = exact[k].p * dr + exact[k].q * z.segment<3>(3 * i);
  }
}

// Solves J step = residual, by GMRES if an earlier Jacobian is factorised.
// False if the Jacobian is singular.
bool FrictionSolver::Impl::NewtonStep(bool factored, VectorXd* step) {
  const auto solve = [this](VectorXd* z) {
    Columns column = *z;
    jacobian.Solve(&column);
    *z = column;
    ++stats.solves;
  };
  if (factored) {
    GmresOptions krylov;
    krylov.tolerance = options.krylov_tolerance;
    krylov.max_iterations = options.krylov_iterations;
    const GmresResult result = Gmres(
        [this](const VectorXd& z, VectorXd* out) { ApplyJacobian(z, out); },
        solve,
        residual,
        krylov,
        step);
    if (result.relative_residual <= options.krylov_tolerance) return true;
  }
  ++stats.factorizations;
  const Stopwatch watch;
  const bool ok = jacobian.Factor(*problem.a, *problem.contacts, v, forces);
  stats.factor_seconds += watch.seconds();
  if (!ok) return false;
  *step = residual;
  solve(step);
  return true;
}

bool FrictionSolver::Impl::Newton() {
  VectorXd best = v, step;
  double least = std::numeric_limits<double>::infinity();
  double milestone = least;
  int since = 0;  // iterations since the residual last halved
  for (int it = 0;; ++it) {
    stats.residual = Evaluate();
    if (stats.residual < least) {
      least = stats.residual;
      best = v;
    }
    if (least <= options.tolerance) return true;
    if (stats.residual < 0.5 * milestone) {
      milestone = stats.residual;
      since = 0;
    } else {
      ++since;
    }
    if (it == options.newton_iterations || since >= kPatience ||
        !std::isfinite(stats.residual) || !NewtonStep(it > 0, &step))
      break;
    v -= step;
    ++stats.newton_iterations;
  }
  v = best;
  stats.residual = Evaluate();
  return false;
}

void FrictionSolver::Impl::CountModes() {
  const auto& contacts = *problem.contacts;
  for (size_t k = 0; k < contacts.size(); ++k) {
    const ContactMode mode =
        contacts[k].exact() ? exact[k].mode : compliant[k].mode;
    ++(mode == ContactMode::kOpen    ? stats.open
       : mode == ContactMode::kStick ? stats.stick
                                     : stats.slide);
  }
}

FrictionStats FrictionSolver::Solve(const FrictionProblem& problem,
                                    const FrictionOptions& options,
                                    VectorXd* v,
                                    std::vector<Vector3d>* forces) {
  Impl& s = *impl_;
  s.problem = problem;
  s.options = options;
  s.stats = {};
  s.v = *v;
  s.forces = *forces;
  s.Prepare();
  if (!s.Factor()) return s.stats;
  const double first = s.stats.factor_seconds;
  const Stopwatch watch;
  for (int attempt = 0; attempt <= options.retries; ++attempt) {
    if (problem.contacts->empty()) {
      s.v = *problem.b;
      s.PreconditionedSolve(&s.v);
    } else {
      s.Admm(options.admm_iterations << attempt);
    }
    s.stats.converged = s.Newton();
    if (s.stats.converged) break;
  }
  s.stats.solve_seconds = watch.seconds() - s.stats.factor_seconds + first;
  s.CountModes();
  *v = s.v;
  *forces = s.forces;
  return s.stats;
}

}  // namespace invsim
