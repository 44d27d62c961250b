// SPDX-License-Identifier: Apache-2.0
#include "invsim/cloth/clearance.h"

#include <gtest/gtest.h>

#include "geometry/shapes.h"

namespace invsim {
namespace {

TEST(Clearance, MeasuresVerticesAndFaces) {
  const TriangleMesh ball = Sphere(4);
  const SurfaceIndex body(ball.vertices, ball.faces);
  // The faces of a coarse sphere sag between its vertices.
  const TriangleMesh cloth = Sphere(1);
  const Clearance c = MeasureClearance(1.2 * cloth.vertices, cloth.faces, body);
  EXPECT_NEAR(c.vertices, 0.2, 1e-12);
  EXPECT_LT(c.faces, 0.05);
  EXPECT_LT(MeasureClearance(0.9 * cloth.vertices, cloth.faces, body).vertices,
            -0.09);
}

TEST(Clearance, PushedClothIsClearAndFarClothStays) {
  const TriangleMesh ball = Sphere(4);
  const SurfaceIndex body(ball.vertices, ball.faces);
  TriangleMesh sheet = Grid(12);
  sheet.vertices.colwise() -= Vector3d(0.5, 0.5, 0);
  sheet.vertices *= 4.0;
  sheet.vertices.row(2).setConstant(0.97);  // dips 3 cm into the ball
  Points cloth = sheet.vertices;
  const Clearance c = PushClear(sheet.faces, body, 0.02, 0.01, &cloth);
  EXPECT_GE(c.vertices, 0.02);
  EXPECT_GE(c.faces, 0.01);
  for (int v = 0; v < cloth.cols(); ++v) {
    const double moved = (cloth.col(v) - sheet.vertices.col(v)).norm();
    EXPECT_LT(moved, 0.1);
    if (sheet.vertices.col(v).head<2>().norm() > 1.9) {
      EXPECT_EQ(moved, 0.0);
    }
  }
}

TEST(Clearance, ClearClothIsLeftAlone) {
  const TriangleMesh ball = Sphere(3);
  const SurfaceIndex body(ball.vertices, ball.faces);
  Points cloth = 1.5 * ball.vertices;
  PushClear(ball.faces, body, 0.1, 0.1, &cloth);
  EXPECT_EQ(cloth, Points(1.5 * ball.vertices));
}

}  // namespace
}  // namespace invsim
