// SPDX-License-Identifier: Apache-2.0
#ifndef INVSIM_GEOMETRY_MESH_H_
#define INVSIM_GEOMETRY_MESH_H_

// A triangle mesh is its vertices and its faces; everything else is derived.

#include <vector>

#include "invsim/base/types.h"

namespace invsim {

struct TriangleMesh {
  Points vertices;  // 3 x N, metres
  Faces faces;      // 3 x F, counter-clockwise from outside
};

// The unit normal of each face (3 x F); zero for a face of no area.
Points FaceNormals(const Points& vertices, const Faces& faces);

// The area of each face in square metres.
VectorXd FaceAreas(const Points& vertices, const Faces& faces);

// Angle-weighted unit vertex normals (3 x N): the pseudo-normal that decides
// inside and outside at a vertex (Baerentzen & Aanaes 2005).
Points VertexNormals(const Points& vertices, const Faces& faces);

// The angle of face `face` at its corner 0, 1 or 2, radians in [0, pi]; zero if
// a side at the corner has no length.
double CornerAngle(const Points& vertices,
                   const Faces& faces,
                   Eigen::Index face,
                   int corner);

// An edge (a, b), a < b, with the face on each side. For a face the vertex
// opposite the edge is kept too: hinge (a, b, opposite[0], opposite[1]). On
// faces[0] the edge runs a -> b counter-clockwise, on faces[1] b -> a, if the
// mesh is consistently oriented. faces[1] = opposite[1] = -1 on a boundary,
// where faces[0] may run either way.
struct Edge {
  int a;
  int b;
  int faces[2];
  int opposite[2];
};

// All edges, sorted by (a, b). Throws InputError naming the edge if more than
// two faces meet at it or two faces run along it the same way, and naming the
// face if it has a vertex twice. Numbers in messages count from 0.
std::vector<Edge> Edges(const Faces& faces);

}  // namespace invsim

#endif  // INVSIM_GEOMETRY_MESH_H_
