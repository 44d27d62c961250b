// SPDX-License-Identifier: Apache-2.0
#include "invsim/sim/penetration.h"

#include <gtest/gtest.h>

#include "geometry/shapes.h"

namespace invsim {
namespace {

// Two unit cubes, the second 0.8 further along x: they share a slab of 0.2.
TriangleMesh TwoCubes() {
  const TriangleMesh cube = UnitCube();
  TriangleMesh two;
  two.vertices.resize(3, 16);
  two.vertices << cube.vertices, cube.vertices.colwise() + Vector3d(0.8, 0, 0);
  two.faces.resize(3, 24);
  two.faces << cube.faces, cube.faces.array() + 8;
  return two;
}

TEST(Penetration, IsTheDepthOfVerticesInside) {
  const TriangleMesh cube = UnitCube();
  const SurfaceIndex body(cube.vertices, cube.faces);
  Points x(3, 3);
  x.col(0) << 0.5, 0.5, 1.01;
  x.col(1) << 0.3, 0.5, 0.98;
  x.col(2) << 0.6, 0.4, 0.95;
  const Penetration p = MeasurePenetration(body, x);
  EXPECT_EQ(p.inside, 2);
  EXPECT_NEAR(p.deepest, 0.05, 1e-12);
  EXPECT_EQ(p.overlap, 0);
}

TEST(Penetration, TellsWhereTheBodyOverlapsItself) {
  const TriangleMesh two = TwoCubes();
  const SurfaceIndex body(two.vertices, two.faces);
  Points x(3, 2);
  x.col(0) << 0.87, 0.5, 0.5;  // in both
  x.col(1) << 0.3, 0.5, 0.96;  // in the first
  const Penetration p = MeasurePenetration(body, x);
  EXPECT_EQ(p.inside, 1);
  EXPECT_NEAR(p.deepest, 0.04, 1e-12);
  EXPECT_EQ(p.overlap, 1);
  EXPECT_NEAR(p.deepest_overlap, 0.07, 1e-12);
}

TEST(Penetration, KeepsTheWorst) {
  Penetration worst{0.002, 3, 0, 0};
  worst.KeepWorst({0.001, 5, 0.01, 1});
  EXPECT_EQ(worst.deepest, 0.002);
  EXPECT_EQ(worst.inside, 5);
  EXPECT_EQ(worst.deepest_overlap, 0.01);
  EXPECT_EQ(worst.overlap, 1);
}

}  // namespace
}  // namespace invsim
