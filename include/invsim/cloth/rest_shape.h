// SPDX-License-Identifier: Apache-2.0
#ifndef INVSIM_CLOTH_REST_SHAPE_H_
#define INVSIM_CLOTH_REST_SHAPE_H_

// Measures of a garment's pattern, face by face.

#include <Eigen/LU>

#include "invsim/cloth/garment.h"

namespace invsim {

// The edges from the first corner of face f to its second and third, as
// columns, in the pattern.
inline Matrix2d RestEdges(const Garment& garment, int f) {
  const auto corner = garment.rest_faces.col(f);
  Matrix2d edges;
  edges.col(0) = garment.rest.col(corner[1]) - garment.rest.col(corner[0]);
  edges.col(1) = garment.rest.col(corner[2]) - garment.rest.col(corner[0]);
  return edges;
}

// m^2; positive for a face that is not inverted.
inline double RestArea(const Garment& garment, int f) {
  return 0.5 * RestEdges(garment, f).determinant();
}

}  // namespace invsim

#endif  // INVSIM_CLOTH_REST_SHAPE_H_
