// SPDX-License-Identifier: Apache-2.0
#ifndef INVSIM_SRC_SIM_CLOTH_DERIVATIVES_H_
#define INVSIM_SRC_SIM_CLOTH_DERIVATIVES_H_

// How the contacts of the cloth with itself in a sub-step move with the cloth
// at its start: normal, velocity and weights. As G holds the weights, they act
// in two places, u = G v - w and the force G^T r: at fixed v and r
//
//   du = dG v - dw,   m += dG^T r   (algebra of contact/friction_jacobian.h).

#include <vector>

#include "invsim/sim/frame_record.h"

namespace invsim {

class ClothDerivatives {
 public:
  // `options` is not read if the sub-step has no such contact.
  ClothDerivatives(const SelfContactOptions* options, const SubstepRecord& sub);

  bool empty() const { return sub_.cloth_sources.empty(); }

  // dn, dw (3 rows per contact of the sub-step) are filled in for x0 moving;
  // returns the weights' moves, 4 rows per contact of the cloth with itself.
  Columns Forward(const Columns& x0, Columns* dn, Columns* dw) const;
  // Their part at one linearisation: dw -= dG v and m += dG^T r.
  void AddForward(const LinearizationRecord& lin,
                  const Columns& weights,
                  Columns* dw,
                  Columns* m) const;

  // The transposes, added to the results: from those of dw and m to the
  // weights', and from dn, dw and the weights to x0.
  void AddAdjoint(const LinearizationRecord& lin,
                  const Columns& dw,
                  const Columns& m,
                  Columns* weights) const;
  void Adjoint(const Columns& dn,
               const Columns& dw,
               const Columns& weights,
               Columns* x0) const;

 private:
  const SubstepRecord& sub_;
  std::vector<ClothPlaneJacobian> jacobians_;
};

}  // namespace invsim

#endif  // INVSIM_SRC_SIM_CLOTH_DERIVATIVES_H_
