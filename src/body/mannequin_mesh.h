// SPDX-License-Identifier: Apache-2.0
#ifndef INVSIM_SRC_BODY_MANNEQUIN_MESH_H_
#define INVSIM_SRC_BODY_MANNEQUIN_MESH_H_

#include <vector>

#include "invsim/geometry/mesh.h"

namespace invsim {

struct MirrorMesh {
  TriangleMesh mesh;
  // The vertex at (-x, y, z) of each vertex; itself in the middle (x = 0).
  std::vector<int> mirror;
};

// The mannequin's surface: its left half polygonised and remeshed, small
// triangles on hands, feet and head, then joined with its mirror image.
MirrorMesh MakeMannequinMesh();

// Joins a mesh with boundary on x = 0, and nothing beyond it, with its image.
MirrorMesh JoinWithMirrorImage(const TriangleMesh& half);

}  // namespace invsim

#endif  // INVSIM_SRC_BODY_MANNEQUIN_MESH_H_
