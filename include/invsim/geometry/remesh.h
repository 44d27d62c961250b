// SPDX-License-Identifier: Apache-2.0
#ifndef INVSIM_GEOMETRY_REMESH_H_
#define INVSIM_GEOMETRY_REMESH_H_

// Isotropic remeshing: the same surface with nearly equilateral triangles of a
// wanted edge length L. Rounds of: split edges longer than 4/3 L, collapse
// edges shorter than 4/5 L, flip edges towards six neighbours a vertex (four
// on a boundary), slide vertices along the surface to the mean of their
// neighbours, and put them back on the input surface (after Botsch & Kobbelt,
// A remeshing approach to multiresolution modeling, 2004, section 4); the last
// rounds flip for the largest smallest angle instead.
//
// The result is a manifold of the input's topology, oriented like it. It lies
// on the input to within the chord error of L. Creases are not kept: the input
// should be smooth at the scale of L.

#include <functional>

#include "invsim/geometry/mesh.h"

namespace invsim {

// The wanted edge length (m) near a point.
using EdgeLengthField = std::function<double(const Vector3d&)>;

struct RemeshOptions {
  int rounds = 12;
  // true: boundary vertices and edges stay as they are. false: boundaries get
  // the wanted edge length too and stay on the input's boundary curves.
  bool keep_boundary = false;
  // Boundary vertices where the boundary turns by more stay in place, degrees;
  // 180: none does.
  double corner_angle = 45.0;
};

// Throws InputError as Edges does, or if the edge length is not positive.
TriangleMesh Remesh(const TriangleMesh& mesh,
                    double edge_length,
                    const RemeshOptions& options = {});
TriangleMesh Remesh(const TriangleMesh& mesh,
                    const EdgeLengthField& edge_length,
                    const RemeshOptions& options = {});

// The smallest angle of each face, radians: how well shaped it is.
VectorXd SmallestAngles(const Points& vertices, const Faces& faces);

}  // namespace invsim

#endif  // INVSIM_GEOMETRY_REMESH_H_
