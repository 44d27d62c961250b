// SPDX-License-Identifier: Apache-2.0
#ifndef INVSIM_CLOTH_GARMENT_H_
#define INVSIM_CLOTH_GARMENT_H_

// A garment: a mesh placed around the T-posed body, and its rest shape, the
// flat sewing pattern. A vertex on a seam has one placed position and several
// pattern points.

#include <string>
#include <string_view>

#include "invsim/base/types.h"

namespace invsim {

struct Garment {
  Points placed;     // 3 x N: around the T-posed body, metres
  Faces faces;       // 3 x F into `placed`
  Points2 rest;      // 2 x R: pattern points, metres; +y is the warp direction
  Faces rest_faces;  // 3 x F into `rest`, corner by corner as `faces`
  // Rest angle of each hinge is that of `placed` (no pattern was given and the
  // rest shape is the 3D shape); otherwise the cloth is flat at rest.
  bool rest_angles_from_placed = false;

  int num_vertices() const { return static_cast<int>(placed.cols()); }
  int num_faces() const { return static_cast<int>(faces.cols()); }
};

// Reads an OBJ: `v` placed shape, `vt` (if present) rest shape in metres.
// Without `vt` each triangle is laid flat by itself with the projection of
// `up` (default +y) along the pattern's +y. Throws InputError naming the file
// and the offending vertex, edge or face (non-manifold, inconsistent
// orientation, no area, inverted rest triangle, wrong unit).
Garment ReadGarment(const std::string& path);
// The same of a file's bytes; `path` opens messages.
Garment ParseGarment(std::string_view obj, const std::string& path);

// The checks of ReadGarment on data already in memory; `name` opens the
// message.
void ValidateGarment(const Garment& garment, const std::string& name);

// A third of the rest area of the faces round each vertex, m^2.
VectorXd VertexAreas(const Garment& garment);

// Garment with the rest shape of a 3D mesh: each triangle laid flat by itself.
Garment GarmentFromRestMesh(const Points& vertices, const Faces& faces);

}  // namespace invsim

#endif  // INVSIM_CLOTH_GARMENT_H_
