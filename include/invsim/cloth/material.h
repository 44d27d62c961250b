// SPDX-License-Identifier: Apache-2.0
#ifndef INVSIM_CLOTH_MATERIAL_H_
#define INVSIM_CLOTH_MATERIAL_H_

// What a cloth is made of. All stiffnesses are those of the sheet, not of a
// solid: a membrane stress is a force per length (N/m), a bending stiffness a
// moment per curvature and length (N m). Axis 1 is the pattern's +x (weft),
// axis 2 its +y (warp).

#include <array>
#include <string>
#include <variant>
#include <vector>

#include "invsim/base/types.h"

namespace invsim {

// St. Venant-Kirchhoff, the same in all directions (plane stress):
//   S = Y / (1 - nu^2) [(1 - nu) E + nu tr(E) I] .
struct IsotropicStretch {
  double stiffness;      // Y = Young's modulus times thickness, N/m; > 0
  double poisson = 0.3;  // nu, -1 < nu < 1
};

// St. Venant-Kirchhoff with the symmetry of a weave:
//   S11 = c11 E11 + c12 E22,  S22 = c12 E11 + c22 E22,  S12 = c33 (2 E12),
// N/m. Positive semi-definite: c11, c22, c33 >= 0, c12^2 <= c11 c22.
struct OrthotropicStretch {
  double c11;
  double c12;
  double c22;
  double c33;
};

// From what textile laboratories report: the stretch stiffness along either
// axis with the other one free (N/m), the shear stiffness (N/m per radian of
// shear angle), and Poisson's ratio nu_12 = -E22 / E11 under a pull along 1.
OrthotropicStretch FromEngineeringConstants(double stiffness_1,
                                            double stiffness_2,
                                            double shear,
                                            double poisson_12);

// Measured fabric of Wang, O'Brien & Ramamoorthi (2011), as ARCSim stores it.
// Row 0 holds (c11, c12, c22, c33) at rest, rows 1 to 5 at one sixth of
// stretch along 0, 22.5, 45, 67.5 and 90 degrees from axis 1. See StretchLaw.
struct MeasuredStretch {
  std::array<std::array<double, 4>, 6> table;  // N/m
};

using StretchModel =
    std::variant<IsotropicStretch, OrthotropicStretch, MeasuredStretch>;

// Energy 1/2 B kappa^2 per area for a sheet rolled to curvature kappa.
struct IsotropicBending {
  double stiffness;  // flexural rigidity B, N m
};

// Measured fabric as ARCSim stores it: rows are bend axes at 0, 45, 90 degrees
// from axis 1, columns five curvatures. See BendingCurve.
struct MeasuredBending {
  std::array<std::array<double, 5>, 3> table;  // N m
};

using BendingModel = std::variant<IsotropicBending, MeasuredBending>;

struct Material {
  std::string name;
  double density;  // kg/m^2
  StretchModel stretch;
  BendingModel bending;
  double friction = 0.3;  // Coulomb's mu against skin, unless a scene says
  std::string doc = {};   // one line: what it is and where the figures are from
};

// Throws InputError, opened by `name` and naming the field, if a figure is not
// finite, not positive, or makes the material unstable.
void ValidateMaterial(const Material& material, const std::string& name);

}  // namespace invsim

#endif  // INVSIM_CLOTH_MATERIAL_H_
