// SPDX-License-Identifier: Apache-2.0
#ifndef INVSIM_GEOMETRY_CUT_H_
#define INVSIM_GEOMETRY_CUT_H_

// Cutting a surface along a curve and keeping a piece of it.

#include "invsim/geometry/mesh.h"

namespace invsim {

// The part of the surface where the linear interpolation of the vertices'
// values is positive (zero counts as positive). The mesh stays a manifold: new
// vertices lie where edges cross zero, but no nearer to an end than a tenth of
// the edge, so that no sliver is left. Vertices keep their order, new ones come
// last. Throws InputError if the numbers of values and vertices differ.
TriangleMesh CutMesh(const TriangleMesh& mesh, const VectorXd& values);

// The piece (vertices joined by edges) that comes nearest to `point`.
TriangleMesh PieceNearest(const TriangleMesh& mesh, const Vector3d& point);

}  // namespace invsim

#endif  // INVSIM_GEOMETRY_CUT_H_
