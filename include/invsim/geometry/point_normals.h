// SPDX-License-Identifier: Apache-2.0
#ifndef INVSIM_GEOMETRY_POINT_NORMALS_H_
#define INVSIM_GEOMETRY_POINT_NORMALS_H_

#include "invsim/geometry/kd_tree.h"

namespace invsim {

// The normal of the surface that points were measured on, at each of them: the
// direction in which its `neighbours` nearest points, itself included, spread
// least (the eigenvector of the smallest eigenvalue of their covariance).
// Unit columns; which side is out is not known, and the sign is arbitrary.
Points EstimateNormals(const KdTree& points, int neighbours = 16);

}  // namespace invsim

#endif  // INVSIM_GEOMETRY_POINT_NORMALS_H_
