// SPDX-License-Identifier: Apache-2.0
#ifndef INVSIM_GEOMETRY_SELF_INTERSECTION_H_
#define INVSIM_GEOMETRY_SELF_INTERSECTION_H_

// Where a surface crosses itself.

#include <array>
#include <vector>

#include "invsim/base/types.h"

namespace invsim {

// Whether the segment (p, q) meets the triangle (a, b, c). Segments in the
// plane of the triangle do not count.
bool SegmentMeetsTriangle(const Vector3d& p,
                          const Vector3d& q,
                          const Vector3d& a,
                          const Vector3d& b,
                          const Vector3d& c);

// The pairs of faces (first < second) that cross each other, sorted: a side of
// one meets the other. Faces that share a vertex are passed over unless the
// side opposite it does so. Throws InputError as SurfaceIndex does.
std::vector<std::array<int, 2>> SelfIntersections(const Points& vertices,
                                                  const Faces& faces);

}  // namespace invsim

#endif  // INVSIM_GEOMETRY_SELF_INTERSECTION_H_
