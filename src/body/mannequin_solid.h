// SPDX-License-Identifier: Apache-2.0
#ifndef INVSIM_SRC_BODY_MANNEQUIN_SOLID_H_
#define INVSIM_SRC_BODY_MANNEQUIN_SOLID_H_

// The mannequin's form: lofts for trunk, legs, feet, arms, hands, neck and
// head, joined smoothly. Proportions after the segment lengths of Drillis and
// Contini (1966, as fractions of stature) for a stature of 1.70 m and girths of
// a slim adult; the sections are our own drawing.

#include "invsim/base/types.h"

namespace invsim {

// Negative inside, close to the distance near the surface, symmetric in x.
// Metres; T-pose, facing +z, soles at y = -1.1.
double MannequinDistance(const Vector3d& x);

}  // namespace invsim

#endif  // INVSIM_SRC_BODY_MANNEQUIN_SOLID_H_
