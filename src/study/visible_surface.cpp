// SPDX-License-Identifier: Apache-2.0
#include "invsim/study/visible_surface.h"

#include <vector>

namespace invsim {

VisibleSurface FindVisibleSurface(const TriangleMesh& body,
                                  const SurfaceIndex& index,
                                  const CoverRay& ray) {
  const std::vector<bool> covered = CoveredVertices(
      body.vertices, VertexNormals(body.vertices, body.faces), index, ray);
  std::vector<int> bare;
  for (int f = 0; f < body.faces.cols(); ++f)
    if (!covered[body.faces(0, f)] && !covered[body.faces(1, f)] &&
        !covered[body.faces(2, f)])
      bare.push_back(f);
  std::vector<int> number(body.vertices.cols(), -1);
  for (const int f : bare)
    for (int k = 0; k < 3; ++k) number[body.faces(k, f)] = 0;
  std::vector<int> used;
  const int cloth_vertices = static_cast<int>(index.vertices().cols());
  for (size_t i = 0; i < number.size(); ++i) {
    if (number[i] < 0) continue;
    number[i] = cloth_vertices + static_cast<int>(used.size());
    used.push_back(static_cast<int>(i));
  }
  VisibleSurface s;
  s.cloth_faces = static_cast<int>(index.faces().cols());
  s.mesh.vertices.resize(3, cloth_vertices + used.size());
  s.mesh.vertices << index.vertices(), body.vertices(Eigen::all, used);
  s.mesh.faces.resize(3, s.cloth_faces + bare.size());
  s.mesh.faces.leftCols(s.cloth_faces) = index.faces();
  for (size_t j = 0; j < bare.size(); ++j)
    for (int k = 0; k < 3; ++k)
      s.mesh.faces(k, s.cloth_faces + j) = number[body.faces(k, bare[j])];
  return s;
}

}  // namespace invsim
