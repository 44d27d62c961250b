// SPDX-License-Identifier: Apache-2.0
#ifndef INVSIM_CLOTH_EFFECTS_TENSION_H_
#define INVSIM_CLOTH_EFFECTS_TENSION_H_

// The tensile part of a membrane stress.
//
// A stress S contributes the geometric stiffness S_ij d_i d_j, which is
// negative along compressed directions: that is how cloth buckles. A convex
// step keeps only S+, S with its negative eigenvalues set to zero (the
// projection onto the positive semi-definite cone, as in Choi & Ko 2002 and
// Teran et al. 2005). For 2x2 it has a closed form: with
//   m = (S11 + S22)/2,  R = S - m I,  r = |eigenvalue of R|,
//   S+ = S                                     if  m >= r  (all tension)
//      = 0                                     if  m <= -r (all compression)
//      = ((m + r) I + (m/r + 1) R) / 2         otherwise.
// Stresses are (S11, S22, S12).

#include "invsim/base/types.h"

namespace invsim {

// S+ of S; `derivative`, if given, receives dS+/dS, 3 x 3. S+ is continuous;
// on the borders between its cases the derivative is that of one side.
Vector3d TensilePart(const Vector3d& stress, Matrix3d* derivative = nullptr);

}  // namespace invsim

#endif  // INVSIM_CLOTH_EFFECTS_TENSION_H_
