// SPDX-License-Identifier: Apache-2.0
#include "invsim/geometry/chamfer.h"

#include <gtest/gtest.h>

#include "geometry/shapes.h"
#include "invsim/base/error.h"

namespace invsim {
namespace {

TEST(Chamfer, DirectionsDiffer) {
  Points a(3, 1), b(3, 3);
  a << 0, 0, 0;
  b << 1, 2, 0,  //
      0, 0, 3,   //
      0, 0, 4;
  const ChamferDistance d = Chamfer(a, b);
  EXPECT_EQ(d.a_to_b, 1.0);
  EXPECT_NEAR(d.b_to_a, (1.0 + 2.0 + 5.0) / 3.0, 1e-15);
  EXPECT_NEAR(d.mean(), (1.0 + 8.0 / 3.0) / 2.0, 1e-15);
}

TEST(Chamfer, SurfaceIsNearerThanItsVertices) {
  const TriangleMesh cube = UnitCube();
  const SurfaceIndex surface(cube.vertices, cube.faces);
  Points q(3, 2);
  q << 0.5, 0.5,  //
      0.5, 0.5,   //
      1.5, 0.75;
  const VectorXd to_surface = DistancesToSurface(q, surface);
  EXPECT_NEAR(to_surface[0], 0.5, 1e-15);
  EXPECT_NEAR(to_surface[1], 0.25, 1e-15);  // inside: unsigned
  const VectorXd to_points = DistancesToPoints(q, KdTree(cube.vertices));
  EXPECT_NEAR(to_points[0], std::sqrt(0.75), 1e-15);
}

TEST(Chamfer, EmptySetsAreRefused) {
  EXPECT_THROW(Chamfer(Points(3, 0), Points::Zero(3, 1)), InputError);
  EXPECT_THROW(Chamfer(Points::Zero(3, 1), Points(3, 0)), InputError);
}

}  // namespace
}  // namespace invsim
