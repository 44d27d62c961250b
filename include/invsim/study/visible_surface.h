// SPDX-License-Identifier: Apache-2.0
#ifndef INVSIM_STUDY_VISIBLE_SURFACE_H_
#define INVSIM_STUDY_VISIBLE_SURFACE_H_

// What can be seen of a clothed person: the garment, and of the body the faces
// that the garment leaves bare.

#include "invsim/fit/coverage.h"
#include "invsim/geometry/mesh.h"

namespace invsim {

struct VisibleSurface {
  // The cloth first, then the bare body vertices and faces, each in their own
  // order.
  TriangleMesh mesh;
  int cloth_faces = 0;
};

// A face of the body is bare if the garment covers none of its vertices
// (CoveredVertices with angle-weighted vertex normals). `index` is that of
// the cloth at its positions now.
VisibleSurface FindVisibleSurface(const TriangleMesh& body,
                                  const SurfaceIndex& index,
                                  const CoverRay& ray = {});

}  // namespace invsim

#endif  // INVSIM_STUDY_VISIBLE_SURFACE_H_
