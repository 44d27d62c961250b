// SPDX-License-Identifier: Apache-2.0
#ifndef INVSIM_SRC_BODY_MANNEQUIN_SHAPE_H_
#define INVSIM_SRC_BODY_MANNEQUIN_SHAPE_H_

#include "invsim/body/mannequin.h"

namespace invsim {

// How far one unit of a shape coefficient carries a point of the T-posed
// mannequin, metres. Smooth in x, and the mirror image of itself.
Vector3d MannequinShapeDisplacement(MannequinShape shape, const Vector3d& x);

}  // namespace invsim

#endif  // INVSIM_SRC_BODY_MANNEQUIN_SHAPE_H_
