// SPDX-License-Identifier: Apache-2.0
#include "splitting_rho.h"

#include <algorithm>
#include <cmath>

namespace invsim {
namespace {

// In units of the vertex's own diagonal of A. The membrane ties neighbours
// together across the normal, so that a vertex is far softer there than its own
// diagonal says.
constexpr double kGuessNormal = 0.5;
constexpr double kGuessTangent = 0.05;
// In units of the guess.
constexpr double kHeld = 10;
constexpr double kOpen = 0.3;
constexpr double kLeastSliding = 0.1;
// In units of the stiffness that a compliant contact has itself. Two that hold
// a vertex between them may press it with far more than all else that acts on
// it, and splitting builds a force up by rho times what is left of the gap.
constexpr double kStiffHeld = 0.1;

}  // namespace

Scaling Scaling::Power(double p) const {
  return {n, std::pow(normal, p), std::pow(tangent, p)};
}

Vector3d Scaling::operator*(const Vector3d& x) const {
  return tangent * x + (normal - tangent) * n.dot(x) * n;
}

Matrix3d Scaling::matrix() const {
  return tangent * Matrix3d::Identity() +
         (normal - tangent) * n * n.transpose();
}

SplittingRho::SplittingRho(const Scaling& r)
    : rho(r),
      inverse(r.Power(-1)),
      root(r.Power(0.5)),
      inverse_root(r.Power(-0.5)) {}

OwnCompliance ComplianceAlone(const BlockMatrix& a, const Contact& c) {
  OwnCompliance own{c.compliance, c.compliance, c.compliance};
  for (int j = 0; j < c.num_vertices; ++j) {
    const Matrix3d diagonal = a.diagonal(c.vertex[j]);
    const double along = c.normal.dot(diagonal * c.normal);
    const double square = c.weight[j] * c.weight[j];
    own.mean += square * 3 / diagonal.trace();
    own.normal += square / along;
    own.tangent += square * 2 / (diagonal.trace() - along);
  }
  return own;
}

Scaling GuessedRho(const Contact& c, const OwnCompliance& own, double share) {
  return {c.normal,
          share * kGuessNormal / own.normal,
          share * kGuessTangent / own.tangent};
}

Scaling FittedRho(const Contact& c,
                  const Scaling& guess,
                  ContactMode mode,
                  const Vector3d& force,
                  const Vector3d& u) {
  if (c.kind == ContactKind::kPin) return guess;
  if (mode == ContactMode::kOpen)
    return {guess.n, kOpen * guess.normal, kOpen * guess.tangent};
  const double stiff = c.exact() ? 0 : kStiffHeld / c.compliance;
  const double normal = std::max(kHeld * guess.normal, stiff);
  const double stiffest = std::max(kHeld * guess.tangent, stiff);
  if (mode == ContactMode::kStick) return {guess.n, normal, stiffest};
  const double slip = (u - c.normal.dot(u) * c.normal).norm();
  const double friction = c.friction * std::max(0.0, c.normal.dot(force));
  // Written so that no slip is the stiffest, not a division by zero.
  const double turning =
      friction < stiffest * slip ? friction / slip : stiffest;
  return {guess.n, normal, std::max(turning, kLeastSliding * guess.tangent)};
}

}  // namespace invsim
