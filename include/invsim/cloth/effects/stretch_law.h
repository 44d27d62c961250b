// SPDX-License-Identifier: Apache-2.0
#ifndef INVSIM_CLOTH_EFFECTS_STRETCH_LAW_H_
#define INVSIM_CLOTH_EFFECTS_STRETCH_LAW_H_

// The law from Green strain to second Piola-Kirchhoff stress in the axes of
// the pattern, in N/m:
//
//   S = C(e) e,   e = (E11, E22, 2 E12),   C = | c11 c12  0  |
//                                              | c12 c22  0  |
//                                              |  0   0  c33 |
//
// The four constants do not change with the strain for St. Venant-Kirchhoff
// models. For a measured fabric (Wang, O'Brien & Ramamoorthi 2011, "Data-Driven
// Elastic Models for Cloth") they do. What their table means is fixed by the
// program it was published with, ARCSim, so we read it the same way:
//
// * With lambda the larger eigenvalue of F^T F = 2 E + I and phi the angle of
//   its direction from axis 1, folded into [0, 90] degrees, the constants are
//   linear in phi between the five measured directions, and linear in the
//   stretch: weight w = 6 (sqrt(lambda) - 1), kept within [0, 1], for the
//   measured row, 1 - w for the row at rest.
// * Negative constants are set to zero, then c11, c12, c22 are doubled, and so
//   is the ratio of S12 to E12; in our notation with 2 E12 that leaves c33 as
//   it is.
// * This is evaluated on a grid of 30 x 30 x 30 strains, E11 and E22 from -1/4
//   and |E12| from 0 in steps of 1/30, and interpolated trilinearly (strains
//   beyond the grid take its border values), which also makes it continuous
//   where the two principal stretches are equal.
// * Ours: at grid points where c12^2 > c11 c22 the fabric would give energy
//   away; there c12 is reduced to sqrt(c11 c22). C is then positive
//   semi-definite everywhere, mixtures of such matrices being such.
//
// Because C depends on the strain and S is not the derivative of an energy,
// a measured fabric is not a conservative material.

#include <vector>

#include "invsim/cloth/material.h"

namespace invsim {

class StretchLaw {
 public:
  // (c11, c12, c22, c33), N/m.
  using Constants = Eigen::Vector4d;
  // Column j: derivative with respect to e_j.
  using ConstantsGradient = Eigen::Matrix<double, 4, 3>;

  explicit StretchLaw(const StretchModel& model);

  // Whether C is the same at every strain, so that S derives from an energy.
  bool linear() const { return samples_.empty(); }

  // C(e); `gradient`, if given, receives its derivative.
  Constants At(const Vector3d& strain,
               ConstantsGradient* gradient = nullptr) const {
    if (!linear()) return Interpolate(strain, gradient);
    if (gradient) gradient->setZero();
    return constants_;
  }

  // C as a matrix.
  static Matrix3d Matrix(const Constants& c) {
    Matrix3d m;
    m << c[0], c[1], 0.0, c[1], c[2], 0.0, 0.0, 0.0, c[3];
    return m;
  }

 private:
  Constants Interpolate(const Vector3d& strain,
                        ConstantsGradient* gradient) const;

  Constants constants_ = Constants::Zero();
  std::vector<Constants> samples_;
};

}  // namespace invsim

#endif  // INVSIM_CLOTH_EFFECTS_STRETCH_LAW_H_
