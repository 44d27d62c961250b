// SPDX-License-Identifier: Apache-2.0
#ifndef INVSIM_GEOMETRY_CHAMFER_H_
#define INVSIM_GEOMETRY_CHAMFER_H_

// How far two shapes are from each other, point by point.

#include "invsim/base/types.h"
#include "invsim/geometry/kd_tree.h"
#include "invsim/geometry/surface_index.h"

namespace invsim {

// From every point of `from` to the nearest of `to`, metres, >= 0.
VectorXd DistancesToPoints(const Points& from, const KdTree& to);
// The same to the nearest point of a surface.
VectorXd DistancesToSurface(const Points& from, const SurfaceIndex& to);

// Means of unsquared distances, metres.
struct ChamferDistance {
  double a_to_b = 0.0;
  double b_to_a = 0.0;
  double mean() const { return 0.5 * (a_to_b + b_to_a); }
};
// Throws InputError if a set is empty.
ChamferDistance Chamfer(const Points& a, const Points& b);

}  // namespace invsim

#endif  // INVSIM_GEOMETRY_CHAMFER_H_
