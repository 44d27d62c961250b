// SPDX-License-Identifier: Apache-2.0
#ifndef INVSIM_CLOTH_EFFECTS_BENDING_CURVE_H_
#define INVSIM_CLOTH_EFFECTS_BENDING_CURVE_H_

// The moment of one hinge against its bend phi = theta - theta_rest:
//
//   m(phi) = k(|phi|) phi,   energy  = integral of m from 0 to phi,
//
// with the secant stiffness k (N m per radian) linear between five nodes at
// equal steps of |phi| and constant beyond the last. A linear hinge has five
// equal nodes.

#include <array>

#include "invsim/cloth/material.h"

namespace invsim {

class BendingCurve {
 public:
  struct Value {
    double stiffness;  // k, N m
    double slope;      // dk/dphi, N m
  };

  BendingCurve(const std::array<double, 5>& nodes, double step)
      : nodes_(nodes), per_radian_(1.0 / step) {}

  Value At(double bend) const;
  // J.
  double Energy(double bend) const;

 private:
  std::array<double, 5> nodes_;
  double per_radian_;  // nodes per radian
};

// One side of a hinge at rest: the direction in which its edge runs in the
// pattern.
struct HingeRest {
  double length;           // of the edge, m
  double area;             // of the two faces together, m^2
  Vector2d directions[2];  // of the edge, in the pattern of either face
};

// Isotropic, flexural rigidity B: k = B l^2 / area. A sheet of equilateral
// triangles rolled in any direction, or of right triangles rolled along a leg,
// then has exactly the energy 1/2 B kappa^2 per area of the continuum (see
// docs/effects/bending.md).
//
// Measured (Wang, O'Brien & Ramamoorthi 2011, as ARCSim reads the table):
// k = K l^2 / (4 area), K from the table at the angle between the edge and
// axis 1 of the pattern, folded into [0, 90] degrees, and at curvature
// |phi| l / area, whose columns are 0, 10, 20, 30, 40 per metre; linear in
// both. Negative values count as zero; of the two sides of a seam the softer
// counts, column by column.
BendingCurve MakeBendingCurve(const BendingModel& model, const HingeRest& rest);

}  // namespace invsim

#endif  // INVSIM_CLOTH_EFFECTS_BENDING_CURVE_H_
