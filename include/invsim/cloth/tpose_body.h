// SPDX-License-Identifier: Apache-2.0
#ifndef INVSIM_CLOTH_TPOSE_BODY_H_
#define INVSIM_CLOTH_TPOSE_BODY_H_

// The body a garment is made for, as plain arrays: any body with SMPL's 24
// joints, standing in the T-pose (zero pose), facing +z, y up, its left on +x.

#include <vector>

#include "invsim/base/joints.h"
#include "invsim/base/types.h"

namespace invsim {

struct TPoseBody {
  Points vertices;   // 3 x V, metres
  Faces faces;       // 3 x F, closed, outward
  Points joints;     // 3 x 24
  MatrixXd weights;  // V x 24 skinning weights, rows sum to one
};

// Throws InputError, one line, unless the arrays fit together, the mesh is
// closed and outward, and the joints stand in a T-pose: head above neck above
// pelvis above knees above ankles, arms level and to the sides, left on +x.
void ValidateTPoseBody(const TPoseBody& body);

// 1 for each face whose three corners belong by more than half to the joints.
std::vector<char> FacesOf(const TPoseBody& body,
                          const std::vector<int>& joints);

}  // namespace invsim

#endif  // INVSIM_CLOTH_TPOSE_BODY_H_
