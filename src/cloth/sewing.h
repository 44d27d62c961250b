// SPDX-License-Identifier: Apache-2.0
#ifndef INVSIM_SRC_CLOTH_SEWING_H_
#define INVSIM_SRC_CLOTH_SEWING_H_

// From a solid round the body and the cuts through it to the mesh of a garment:
// the solid's surface without what is cut away, with even openings and
// well-shaped triangles, clear of the skin and of itself.

#include <functional>
#include <string>
#include <vector>

#include "invsim/geometry/mesh.h"
#include "invsim/geometry/scalar_grid.h"
#include "invsim/geometry/surface_index.h"

namespace invsim {

using Field = std::function<double(const Vector3d&)>;

struct SewingPattern {
  std::string name;         // of the garment, for messages
  const ScalarGrid& solid;  // negative inside
  std::vector<Field> cuts;  // the garment is where all are positive
  Vector3d inside;          // of the pieces left, the one nearest to this
  const SurfaceIndex& skin;
  int openings;        // how many it must have
  double edge_length;  // m
  double ease;         // m, off the skin
};

// Throws InputError if the result is not what is promised: its openings, one
// piece without handles, no crossing faces, 3 mm (vertices) and 2 mm (faces)
// off the skin.
TriangleMesh SewGarment(const SewingPattern& pattern);

}  // namespace invsim

#endif  // INVSIM_SRC_CLOTH_SEWING_H_
