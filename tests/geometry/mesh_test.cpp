// SPDX-License-Identifier: Apache-2.0
#include "invsim/geometry/mesh.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "geometry/shapes.h"
#include "invsim/base/error.h"

namespace invsim {
namespace {

using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

TEST(Mesh, CubeHasUnitNormalsAndAreaSix) {
  const TriangleMesh cube = UnitCube();
  EXPECT_NEAR(FaceAreas(cube.vertices, cube.faces).sum(), 6.0, 1e-15);
  const Points n = FaceNormals(cube.vertices, cube.faces);
  for (int f = 0; f < cube.faces.cols(); ++f) {
    Vector3d centre = Vector3d::Zero();
    for (int c = 0; c < 3; ++c)
      centre += cube.vertices.col(cube.faces(c, f)) / 3.0;
    EXPECT_NEAR(n.col(f).norm(), 1.0, 1e-15);
    EXPECT_GT(n.col(f).dot(centre - Vector3d::Constant(0.5)), 0.0);
  }
}

// The angle weights make the corner normal of a cube its diagonal, however the
// sides are cut into triangles.
TEST(Mesh, VertexNormalsOfACubeAreItsDiagonals) {
  const TriangleMesh cube = UnitCube();
  const Points n = VertexNormals(cube.vertices, cube.faces);
  for (int i = 0; i < 8; ++i) {
    const Vector3d diagonal =
        (cube.vertices.col(i) - Vector3d::Constant(0.5)).normalized();
    EXPECT_LT((n.col(i) - diagonal).norm(), 1e-14);
  }
}

TEST(Mesh, FaceOfNoAreaHasZeroNormal) {
  Points x(3, 3);
  x << 0, 1, 2, 0, 0, 0, 0, 0, 0;
  const Faces f = Eigen::Vector3i(0, 1, 2);
  EXPECT_EQ(FaceNormals(x, f).norm(), 0.0);
  EXPECT_EQ(FaceAreas(x, f)[0], 0.0);
  EXPECT_EQ(VertexNormals(x, f).norm(), 0.0);
}

TEST(Mesh, CornerAnglesOfAFaceAddToPi) {
  const TriangleMesh sphere = Sphere(1);
  for (int f = 0; f < sphere.faces.cols(); ++f) {
    double sum = 0.0;
    for (int c = 0; c < 3; ++c)
      sum += CornerAngle(sphere.vertices, sphere.faces, f, c);
    EXPECT_NEAR(sum, std::numbers::pi, 1e-14);
  }
}

TEST(Mesh, EdgesOfAClosedMesh) {
  const TriangleMesh sphere = Sphere(2);
  const auto edges = Edges(sphere.faces);
  // Euler: V - E + F = 2.
  EXPECT_EQ(sphere.vertices.cols() - static_cast<int>(edges.size()) +
                sphere.faces.cols(),
            2);
  for (const Edge& e : edges) {
    EXPECT_LT(e.a, e.b);
    for (int side = 0; side < 2; ++side) {
      const int from = side == 0 ? e.a : e.b, to = side == 0 ? e.b : e.a;
      ASSERT_GE(e.faces[side], 0);
      bool found = false;
      for (int c = 0; c < 3; ++c)
        found |= sphere.faces(c, e.faces[side]) == from &&
                 sphere.faces((c + 1) % 3, e.faces[side]) == to &&
                 sphere.faces((c + 2) % 3, e.faces[side]) == e.opposite[side];
      EXPECT_TRUE(found);
    }
  }
}

TEST(Mesh, BoundaryEdgesHaveOneFace) {
  const auto edges = Edges(Eigen::Vector3i(2, 0, 1));
  ASSERT_EQ(edges.size(), 3u);
  EXPECT_EQ(edges[0].a, 0);
  EXPECT_EQ(edges[0].b, 1);
  EXPECT_EQ(edges[0].opposite[0], 2);
  for (const Edge& e : edges) {
    EXPECT_EQ(e.faces[0], 0);
    EXPECT_EQ(e.faces[1], -1);
    EXPECT_EQ(e.opposite[1], -1);
  }
}

TEST(Mesh, EdgesNameWhatIsWrong) {
  Faces three(3, 3);
  three << 0, 1, 0, 1, 0, 1, 2, 3, 4;
  EXPECT_THAT([&] { Edges(three); },
              ThrowsMessage<InputError>(HasSubstr("edge (0, 1) has 3 faces")));
  Faces flipped(3, 2);
  flipped << 0, 0, 1, 1, 2, 3;
  EXPECT_THAT([&] { Edges(flipped); },
              ThrowsMessage<InputError>(
                  HasSubstr("edge (0, 1) runs the same way on faces 0 and 1")));
  EXPECT_THAT(
      [&] { Edges(Eigen::Vector3i(4, 4, 2)); },
      ThrowsMessage<InputError>(HasSubstr("face 0 has vertex 4 twice")));
}

}  // namespace
}  // namespace invsim
