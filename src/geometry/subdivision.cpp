// SPDX-License-Identifier: Apache-2.0
#include "invsim/geometry/subdivision.h"

namespace invsim {

Subdivision SubdivideMidpoint(const TriangleMesh& mesh) {
  const std::vector<Edge> edges = Edges(mesh.faces);
  const auto old = static_cast<int>(mesh.vertices.cols());
  const int count = old + static_cast<int>(edges.size());
  Subdivision r;
  r.parents.resize(2, count);
  for (int i = 0; i < old; ++i) r.parents.col(i).setConstant(i);

  // middle(c, f): the new vertex on the side of f opposite its corner c.
  Faces middle(3, mesh.faces.cols());
  for (int e = 0; e < static_cast<int>(edges.size()); ++e) {
    r.parents.col(old + e) << edges[e].a, edges[e].b;
    for (int side = 0; side < 2; ++side) {
      const int f = edges[e].faces[side];
      if (f < 0) continue;
      for (int c = 0; c < 3; ++c)
        if (mesh.faces(c, f) == edges[e].opposite[side]) middle(c, f) = old + e;
    }
  }
  r.mesh.vertices.resize(3, count);
  for (int i = 0; i < count; ++i)
    r.mesh.vertices.col(i) = 0.5 * (mesh.vertices.col(r.parents(0, i)) +
                                    mesh.vertices.col(r.parents(1, i)));
  r.mesh.faces.resize(3, 4 * mesh.faces.cols());
  for (int f = 0; f < mesh.faces.cols(); ++f) {
    for (int c = 0; c < 3; ++c)
      r.mesh.faces.col(4 * f + c) << mesh.faces(c, f), middle((c + 2) % 3, f),
          middle((c + 1) % 3, f);
    r.mesh.faces.col(4 * f + 3) = middle.col(f);
  }
  return r;
}

}  // namespace invsim
