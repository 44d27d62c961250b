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

// Whether a side of face f meets face g or one of g meets f; of faces that
// share a vertex, a side without it.
bool FacesCross(const Points& vertices, const Faces& faces, int f, int g);

// The pairs of faces (first < second) that cross each other, sorted. Throws
// InputError as SurfaceIndex does.
std::vector<std::array<int, 2>> SelfIntersections(const Points& vertices,
                                                  const Faces& faces);

}  // namespace invsim

#endif  // INVSIM_GEOMETRY_SELF_INTERSECTION_H_
