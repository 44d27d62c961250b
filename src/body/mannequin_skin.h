// SPDX-License-Identifier: Apache-2.0
#ifndef INVSIM_SRC_BODY_MANNEQUIN_SKIN_H_
#define INVSIM_SRC_BODY_MANNEQUIN_SKIN_H_

// Which joint carries which skin of the mannequin, and how far.

#include "invsim/body/body_model.h"
#include "mannequin_mesh.h"

namespace invsim {

// Where the joints of the mannequin are meant to be, 3 x 24, metres.
const Points& MannequinJoints();
// SMPL's tree.
const std::vector<int>& MannequinParents();

// V x 24: at most four weights a vertex, positive, rows summing to one, smooth
// over the surface, mirror images equal.
MatrixXd MannequinWeights(const MirrorMesh& body);

// 24 x V: rows of positive weights of the vertices round each joint, summing
// to one, whose mean is the joint exactly.
MatrixXd MannequinRegressor(const MirrorMesh& body);

// Shares of a point of the T-posed mannequin: 0 to 1, smooth.
double ArmShare(const Vector3d& x);      // either arm, from the shoulder out
double LeftLegShare(const Vector3d& x);  // from the groin down
double HeadShare(const Vector3d& x);     // head and upper neck

}  // namespace invsim

#endif  // INVSIM_SRC_BODY_MANNEQUIN_SKIN_H_
