// SPDX-License-Identifier: Apache-2.0
#ifndef INVSIM_GEOMETRY_SUBDIVISION_H_
#define INVSIM_GEOMETRY_SUBDIVISION_H_

// Midpoint subdivision: every edge gets a vertex in its middle, every face
// becomes four similar ones of half the size. The shape does not change.

#include "invsim/geometry/mesh.h"

namespace invsim {

struct Subdivision {
  TriangleMesh mesh;  // old vertices first, then one per edge in Edges' order
  // 2 x N: the old vertices whose mean the new vertex is; (i, i) for the old.
  // Carries anything else that lives on vertices.
  Eigen::Matrix2Xi parents;
};

// Faces 4f .. 4f + 3 come from face f; the last is the middle one. Throws
// InputError as Edges does.
Subdivision SubdivideMidpoint(const TriangleMesh& mesh);

}  // namespace invsim

#endif  // INVSIM_GEOMETRY_SUBDIVISION_H_
