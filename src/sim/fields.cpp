// SPDX-License-Identifier: Apache-2.0
#include "invsim/sim/fields.h"

#include <algorithm>
#include <cmath>

#include "invsim/cloth/effects/membrane.h"
#include "invsim/geometry/mesh.h"

namespace invsim {
namespace {

// Of (E11, E22, 2 E12).
double LargestStretch(const Vector3d& strain) {
  const double mean = 0.5 * (strain[0] + strain[1]);
  const double largest =
      mean + 0.5 * std::hypot(strain[0] - strain[1], strain[2]);
  return std::sqrt(std::max(0.0, 1 + 2 * largest)) - 1;
}

}  // namespace

ClothFields MeasureCloth(const Garment& garment,
                         const StretchModel& model,
                         const Points& x) {
  const MembraneFields fields = Membrane(garment, model).Fields(x);
  MatrixXd per_face(2, garment.num_faces());
  for (int f = 0; f < garment.num_faces(); ++f) {
    per_face(0, f) = LargestStretch(fields.strain.col(f));
    per_face(1, f) = fields.von_mises[f];
  }
  const MatrixXd per_vertex = FaceToVertexAverage(garment, per_face);
  return {per_vertex.row(0), per_vertex.row(1)};
}

VectorXd Pressure(const Points& vertices,
                  const Faces& faces,
                  const Points& force) {
  const VectorXd face_areas = FaceAreas(vertices, faces);
  VectorXd areas = VectorXd::Zero(vertices.cols());
  for (int f = 0; f < faces.cols(); ++f)
    for (int k = 0; k < 3; ++k) areas[faces(k, f)] += face_areas[f] / 3;
  const Points normals = VertexNormals(vertices, faces);
  VectorXd pressure = VectorXd::Zero(vertices.cols());
  for (int i = 0; i < vertices.cols(); ++i)
    if (areas[i] > 0)
      pressure[i] = -force.col(i).dot(normals.col(i)) / areas[i];
  return pressure;
}

}  // namespace invsim
