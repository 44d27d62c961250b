// SPDX-License-Identifier: Apache-2.0
#ifndef INVSIM_SRC_CONTACT_SPLITTING_RHO_H_
#define INVSIM_SRC_CONTACT_SPLITTING_RHO_H_

// rho of splitting (contact/friction_solver.h): per contact a symmetric 3x3
// matrix, kg/s, with one value along the normal and one across it. Splitting
// converges with any; how fast depends on it. A constraint that holds wants a
// large rho, a force that is known already a small one.

#include "invsim/algebra/block_matrix.h"
#include "invsim/contact/contact.h"
#include "invsim/contact/coulomb.h"

namespace invsim {

// The matrix normal n n^T + tangent (1 - n n^T).
struct Scaling {
  Vector3d n;
  double normal, tangent;

  Scaling Power(double p) const;
  Vector3d operator*(const Vector3d& x) const;
  Matrix3d matrix() const;
};

struct SplittingRho {
  SplittingRho() = default;
  explicit SplittingRho(const Scaling& r);
  Scaling rho, inverse, root, inverse_root;
};

// Relative velocity per force (s/kg) at a contact whose vertices are alone in
// the world: of A its diagonal blocks, and the contact's own compliance.
struct OwnCompliance {
  double mean, normal, tangent;
};
OwnCompliance ComplianceAlone(const BlockMatrix& a, const Contact& c);

// What rho is while it is not known what the contacts do: a share of the
// vertices' own, times `share`.
Scaling GuessedRho(const Contact& c, const OwnCompliance& own, double share);

// What it becomes once that is known, from the guess; `force` (N) and `u` (m/s)
// are the contact's. What is closed is held firmly along the normal, and across
// it if it sticks (firmer still if it is stiff itself); what is open hardly.
// Friction that slides turns with the slip: its stiffness across the slip,
// mu r_N / |u_T|, is rho there.
Scaling FittedRho(const Contact& c,
                  const Scaling& guess,
                  ContactMode mode,
                  const Vector3d& force,
                  const Vector3d& u);

}  // namespace invsim

#endif  // INVSIM_SRC_CONTACT_SPLITTING_RHO_H_
