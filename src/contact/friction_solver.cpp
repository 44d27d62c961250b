// SPDX-License-Identifier: Apache-2.0
#include "invsim/contact/friction_solver.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

#include "invsim/algebra/anderson.h"
#include "invsim/algebra/cholesky_preconditioner.h"
#include "invsim/algebra/gmres.h"
#include "invsim/algebra/sparse_cholesky.h"
#include "invsim/base/stopwatch.h"
#include "invsim/contact/contact_pattern.h"
#include "invsim/contact/friction_jacobian.h"
#include "settling.h"
#include "splitting_rho.h"

namespace invsim {
namespace {

// Newton has stagnated if its residual did not halve in so many iterations.
constexpr int kPatience = 3;
// What cycles with one rho may settle with another: the share of its guess in
// the first attempt and each retry.
constexpr double kRhoOfAttempt[] = {1, 0.1, 10, 0.01};
// Refinement goes on while a step leaves less than this of the residual.
constexpr double kRefinement = 0.1;
// A factor that leaves more of an error than this at every turn is too coarse.
constexpr double kCoarse = 0.3;
// Fitting rho to the modes and factorising anew costs as much as some tens of
// iterations; it is done if more than these are yet to come.
constexpr double kFit = 30;
// Differences that the acceleration of splitting remembers.
constexpr int kMemory = 15;

}  // namespace

struct FrictionSolver::Impl {
  explicit Impl(std::shared_ptr<const BlockPattern> p)
      : pattern(p), single(p), augmented(p), anderson(kMemory), jacobian(p) {}

  void UsePattern();
  void Prepare(double rho_share);
  bool Factor();
  bool FactorInDouble();
  bool Coarse();
  void Precondition(VectorXd* z);
  void StartSplitting();
  void SplittingStep();
  bool FitRho();
  bool Refine();
  bool Split(int iterations);
  double Evaluate();
  void Linearize();
  void ApplyJacobian(const VectorXd& z, VectorXd* out) const;
  bool NewtonStep(bool factored, VectorXd* step);
  bool Newton();
  void CountModes();

  ContactPattern pattern;  // of P
  // The factor of P: in single precision, or in double if that failed.
  CholeskyPreconditioner single;
  std::unique_ptr<SparseCholesky> cholesky;
  bool in_double = false;
  BlockMatrix augmented;  // P
  // Of splitting: sqrt(rho) q of all contacts, its image, and the corrections
  // of v.
  AndersonAcceleration anderson;
  VectorXd q, image, correction;
  FrictionJacobian jacobian;

  FrictionProblem problem;
  FrictionOptions options;
  FrictionStats stats;
  VectorXd v;
  std::vector<Vector3d> forces;
  // Per contact: the vertex's own diagonal of A (with compliance), in which
  // velocities are turned into forces, and splitting's rho.
  std::vector<double> delassus_inverse;
  std::vector<SplittingRho> scale;
  // Of splitting: each contact's force by the law, and what mode that is.
  std::vector<Vector3d> lawful;
  std::vector<ContactMode> modes;
  std::vector<int> exact_on;  // per vertex: its exact contact, or -1

  // At the current v: A v and g = A v - b - compliant forces.
  VectorXd av;
  VectorXd g;
  // The linearisation there.
  VectorXd residual;
  std::vector<ContactLinearization> exact;     // of exact contacts
  std::vector<CompliantDerivative> compliant;  // of the others
};

FrictionSolver::FrictionSolver(std::shared_ptr<const BlockPattern> pattern)
    : impl_(std::make_unique<Impl>(std::move(pattern))) {}
FrictionSolver::~FrictionSolver() = default;

// Analyses the pattern anew after it changed.
void FrictionSolver::Impl::UsePattern() {
  single = CholeskyPreconditioner(pattern.pattern());
  augmented = BlockMatrix(pattern.pattern());
  cholesky.reset();
}

void FrictionSolver::Impl::Prepare(double rho_share) {
  const auto& contacts = *problem.contacts;
  delassus_inverse.resize(contacts.size());
  scale.resize(contacts.size());
  exact_on.assign(problem.a->size(), -1);
  if (pattern.Cover(contacts)) UsePattern();
  for (size_t k = 0; k < contacts.size(); ++k) {
    const Contact& c = contacts[k];
    const OwnCompliance own = ComplianceAlone(*problem.a, c);
    delassus_inverse[k] = 1 / own.mean;
    scale[k] = SplittingRho(GuessedRho(c, own, rho_share));
    if (c.exact()) exact_on[c.vertex[0]] = static_cast<int>(k);
  }
  exact.resize(contacts.size());
  compliant.resize(contacts.size());
  lawful.resize(contacts.size());
  modes.resize(contacts.size());
}

bool FrictionSolver::Impl::Factor() {
  augmented.Assign(*problem.a);
  const BlockPattern& p = *pattern.pattern();
  for (size_t k = 0; k < scale.size(); ++k) {
    const Contact& c = (*problem.contacts)[k];
    for (int i = 0; i < c.num_vertices; ++i)
      for (int j = 0; j < c.num_vertices; ++j)
        augmented.block(p.Find(c.vertex[i], c.vertex[j])) +=
            scale[k].rho.matrix() * (c.weight[i] * c.weight[j]);
  }
  if (in_double) return FactorInDouble();
  const Stopwatch watch;
  const bool ok = single.Factor(augmented);
  stats.factor_seconds += watch.seconds();
  ++stats.factorizations;
  return ok || FactorInDouble();
}

bool FrictionSolver::Impl::FactorInDouble() {
  const Stopwatch watch;
  if (!cholesky) cholesky = std::make_unique<SparseCholesky>(pattern.pattern());
  in_double = true;
  stats.factorization_failed = !cholesky->Factor(augmented);
  stats.factor_seconds += watch.seconds();
  ++stats.factorizations;
  return !stats.factorization_failed;
}

// Whether refinement with the factor hardly gains: P's condition is beyond
// single precision, as of cloth with slivers. The share of an error that a turn
// leaves, e - M^-1 P e, is looked at twice, so that the worst of it shows.
bool FrictionSolver::Impl::Coarse() {
  VectorXd e(3 * problem.a->size()), next;
  for (Eigen::Index i = 0; i < e.size(); ++i) e[i] = std::sin(1.0 + i * i % 97);
  double share = 0;
  for (int turn = 0; turn < 2; ++turn) {
    next = augmented * e;
    Precondition(&next);
    next = e - next;
    share = next.norm() / e.norm();
    e = next;
  }
  return !(share < kCoarse);
}

void FrictionSolver::Impl::Precondition(VectorXd* z) {
  if (in_double) {
    cholesky->Solve(z);
  } else {
    single.Solve(z);
  }
  ++stats.solves;
}

void FrictionSolver::Impl::StartSplitting() {
  const auto& contacts = *problem.contacts;
  q.resize(3 * contacts.size());
  image.resize(q.size());
  for (size_t k = 0; k < contacts.size(); ++k) {
    const Contact& c = contacts[k];
    q.segment<3>(3 * k) = scale[k].root * (c.Gather(v) - c.velocity -
                                           scale[k].inverse * forces[k]);
  }
  anderson.Reset();
}

// Douglas-Rachford splitting, which is ADMM on
//
//   min 1/2 v^T A v - b^T v   with the contact law on z = G v - w,
//
// as a fixed point of q = z - r/rho: the law with u = q + r/rho gives r and
// z = u, then P v = b + sum G^T (rho (z + w) + r), and q moves by G v - w - z.
// P is solved by one step of refinement from the last v, so that the precision
// of its factor is no limit: as q settles, so does v, on the exact solution.
void FrictionSolver::Impl::SplittingStep() {
  const auto& contacts = *problem.contacts;
  correction = *problem.b - av;
  for (size_t k = 0; k < contacts.size(); ++k) {
    const Contact& c = contacts[k];
    const Vector3d at = scale[k].inverse_root * q.segment<3>(3 * k);
    const bool pin = c.kind == ContactKind::kPin;
    const Vector3d r =
        pin ? Vector3d(-(scale[k].rho * at))
            : CompliantForce(c.normal,
                             c.friction,
                             scale[k].inverse.normal + c.compliance,
                             scale[k].inverse.tangent + c.compliance,
                             at);
    lawful[k] = r;
    modes[k] = pin ? ContactMode::kStick : ModeOf(c.normal, c.friction, r);
    const Vector3d z = at + scale[k].inverse * r;
    c.Scatter(scale[k].rho * (z + c.velocity - c.Gather(v)) + r, &correction);
    image.segment<3>(3 * k) =
        q.segment<3>(3 * k) - scale[k].root * (z + c.velocity);
  }
  Precondition(&correction);
  v += correction;
  for (size_t k = 0; k < contacts.size(); ++k)
    image.segment<3>(3 * k) += scale[k].root * contacts[k].Gather(v);
  ++stats.admm_iterations;
}

// Splitting goes on from where it is, with the rho of the modes it came to.
bool FrictionSolver::Impl::FitRho() {
  const auto& contacts = *problem.contacts;
  for (size_t k = 0; k < contacts.size(); ++k) {
    const Contact& c = contacts[k];
    scale[k] = SplittingRho(FittedRho(
        c, scale[k].rho, modes[k], lawful[k], c.Gather(v) - c.velocity));
  }
  if (!Factor()) {  // what splitting came to stands
    stats.factorization_failed = false;
    return false;
  }
  StartSplitting();
  return true;
}

// Without contact a step is one of plain refinement: on to the last digit.
bool FrictionSolver::Impl::Refine() {
  double now = std::numeric_limits<double>::infinity();
  double last;
  StartSplitting();
  av = *problem.a * v;
  do {
    last = now;
    SplittingStep();
    now = Evaluate();
  } while (now < kRefinement * last);
  stats.residual = now;
  return stats.residual <= options.tolerance;
}

// True once the problem is solved; else v is the best that was met.
bool FrictionSolver::Impl::Split(int iterations) {
  VectorXd best = v;
  double least = std::numeric_limits<double>::infinity();
  Settling settling;
  bool fitted = false;
  StartSplitting();
  av = *problem.a * v;
  for (int it = 0; it < iterations; ++it) {
    SplittingStep();
    stats.residual = Evaluate();
    if (stats.residual <= options.tolerance) return true;
    if (!std::isfinite(stats.residual)) break;
    if (stats.residual < least) {
      least = stats.residual;
      best = v;
    }
    settling.Add(stats.residual, modes);
    if (!fitted && settling.ModesRest() &&
        settling.IterationsLeft(options.tolerance) > kFit) {
      fitted = true;
      if (!FitRho()) break;
    } else {
      anderson.Next(image, &q);
    }
  }
  v = best;
  return false;
}

// Fills av, g and the forces; returns the reported residual.
double FrictionSolver::Impl::Evaluate() {
  const auto& contacts = *problem.contacts;
  av = *problem.a * v;
  g = av - *problem.b;
  for (size_t k = 0; k < contacts.size(); ++k) {
    const Contact& c = contacts[k];
    if (c.exact()) continue;
    const Vector3d at = c.Gather(v) - c.velocity;
    forces[k] = CompliantForce(c.normal, c.friction, c.compliance, at);
    c.Scatter(-forces[k], &g);
  }
  double worst = 0;
  for (int i = 0; i < problem.a->size(); ++i) {
    const int k = exact_on[i];
    const Vector3d r = g.segment<3>(3 * i);
    double error = r.norm();
    if (k >= 0) {
      const Contact& c = contacts[k];
      const Vector3d u = v.segment<3>(3 * i) - c.velocity;
      forces[k] = r;
      error = c.kind == ContactKind::kPin
                  ? delassus_inverse[k] * u.norm()
                  : FischerBurmeister(
                        c.normal, c.friction, delassus_inverse[k], r, u)
                        .norm();
    }
    worst = std::max(worst, error / (*problem.weight)[i]);
    if (!std::isfinite(error)) return std::numeric_limits<double>::infinity();
  }
  return worst;
}

// Fills residual and the linearisations where Evaluate was called.
void FrictionSolver::Impl::Linearize() {
  const auto& contacts = *problem.contacts;
  residual = g;
  for (size_t k = 0; k < contacts.size(); ++k) {
    const Contact& c = contacts[k];
    const Vector3d u = c.Gather(v) - c.velocity;
    if (!c.exact()) {
      compliant[k] =
          DifferentiateCompliantForce(c.normal, c.friction, c.compliance, u);
      continue;
    }
    const double own = delassus_inverse[k];
    exact[k] =
        c.kind == ContactKind::kPin
            ? ContactLinearization{ContactMode::kStick,
                                   Matrix3d::Zero(),
                                   own * Matrix3d::Identity(),
                                   own * u,
                                   Matrix3d::Zero()}
            : LinearizeAlartCurnier(c.normal, c.friction, own, forces[k], u);
    residual.segment<3>(3 * c.vertex[0]) = exact[k].residual;
  }
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
        !std::isfinite(stats.residual))
      break;
    Linearize();
    if (!NewtonStep(it > 0, &step)) break;
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

void FrictionSolver::Forget() {
  if (impl_->pattern.Reset()) impl_->UsePattern();
  impl_->jacobian.Forget();
}

FrictionStats FrictionSolver::Solve(const FrictionProblem& problem,
                                    const FrictionOptions& options,
                                    VectorXd* v,
                                    std::vector<Vector3d>* forces) {
  Impl& s = *impl_;
  s.problem = problem;
  s.options = options;
  s.stats = {};
  s.in_double = false;
  s.v = *v;
  s.forces = *forces;
  const Stopwatch watch;
  const auto split = [&](int attempt) {
    return problem.contacts->empty()
               ? s.Refine()
               : s.Split(options.admm_iterations << attempt);
  };
  for (int attempt = 0; attempt <= options.retries; ++attempt) {
    // Without contacts there is no rho.
    if (attempt == 0 || !problem.contacts->empty()) {
      s.Prepare(kRhoOfAttempt[attempt % std::size(kRhoOfAttempt)]);
      const bool ok = s.Factor();
      if (!ok && attempt == 0) return s.stats;
      if (!ok) {  // what the attempts before came to stands
        s.stats.factorization_failed = false;
        break;
      }
    }
    s.stats.converged = split(attempt);
    if (!s.stats.converged && !s.in_double && s.Coarse())
      s.stats.converged = s.FactorInDouble() && split(attempt);
    if (s.stats.factorization_failed) return s.stats;
    s.stats.converged = s.stats.converged || s.Newton();
    if (s.stats.converged) break;
  }
  s.stats.solve_seconds = watch.seconds() - s.stats.factor_seconds;
  s.Linearize();
  s.CountModes();
  *v = s.v;
  *forces = s.forces;
  return s.stats;
}

}  // namespace invsim
