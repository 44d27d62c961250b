// SPDX-License-Identifier: Apache-2.0
#include "invsim/geometry/subdivision.h"

#include <gtest/gtest.h>

#include "geometry/shapes.h"
#include "invsim/geometry/topology.h"

namespace invsim {
namespace {

TEST(Subdivision, KeepsShapeAndTopology) {
  for (const TriangleMesh& m : {UnitCube(), Grid(3), Sphere(1)}) {
    const Subdivision s = SubdivideMidpoint(m);
    ValidateMesh(s.mesh.vertices, s.mesh.faces, "subdivided");
    EXPECT_EQ(EulerCharacteristic(s.mesh.faces), EulerCharacteristic(m.faces));
    EXPECT_EQ(s.mesh.vertices.leftCols(m.vertices.cols()), m.vertices);
    const VectorXd fine = FaceAreas(s.mesh.vertices, s.mesh.faces);
    const VectorXd coarse = FaceAreas(m.vertices, m.faces);
    const Points n = FaceNormals(s.mesh.vertices, s.mesh.faces);
    const Points n0 = FaceNormals(m.vertices, m.faces);
    for (int f = 0; f < m.faces.cols(); ++f) {
      for (int k = 0; k < 4; ++k) {
        EXPECT_NEAR(fine[4 * f + k], coarse[f] / 4, 1e-15);
        EXPECT_LT((n.col(4 * f + k) - n0.col(f)).norm(), 1e-13);
      }
    }
  }
}

TEST(Subdivision, ParentsCarryVertexData) {
  const TriangleMesh m = Sphere(1);
  const Subdivision s = SubdivideMidpoint(m);
  for (int i = 0; i < s.mesh.vertices.cols(); ++i) {
    const Vector3d mean = 0.5 * (m.vertices.col(s.parents(0, i)) +
                                 m.vertices.col(s.parents(1, i)));
    EXPECT_EQ(mean, Vector3d(s.mesh.vertices.col(i)));
  }
}

}  // namespace
}  // namespace invsim
