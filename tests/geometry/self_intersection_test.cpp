// SPDX-License-Identifier: Apache-2.0
#include "invsim/geometry/self_intersection.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "geometry/shapes.h"

namespace invsim {
namespace {

using ::testing::ElementsAre;

TEST(SelfIntersection, SegmentAndTriangle) {
  const Vector3d a(0, 0, 0), b(1, 0, 0), c(0, 1, 0);
  const Vector3d inside(0.2, 0.3, 0), outside(0.8, 0.8, 0), z(0, 0, 1);
  EXPECT_TRUE(SegmentMeetsTriangle(inside - z, inside + z, a, b, c));
  EXPECT_TRUE(SegmentMeetsTriangle(inside + z, inside - z, a, b, c));
  EXPECT_FALSE(SegmentMeetsTriangle(inside + z, inside + 2 * z, a, b, c));
  EXPECT_FALSE(SegmentMeetsTriangle(outside - z, outside + z, a, b, c));
  EXPECT_FALSE(SegmentMeetsTriangle(a, b, a, b, c));
}

TEST(SelfIntersection, CleanMeshesHaveNone) {
  for (const TriangleMesh& m : {Sphere(3), UnitCube(), Grid(5)})
    EXPECT_TRUE(SelfIntersections(m.vertices, m.faces).empty());
}

TEST(SelfIntersection, FindsAPokedFace) {
  // A separate face that stabs one face of a sheet.
  Points x(3, 7);
  x << 0, 1, 0, 1, 0.6, 0.6, 0.65,  //
      0, 0, 1, 1, 0.2, 0.3, 0.2,    //
      0, 0, 0, 0, -1.0, 1.0, 1.0;
  Faces f(3, 3);
  f << 0, 0, 4, 1, 3, 5, 3, 2, 6;
  EXPECT_THAT(SelfIntersections(x, f), ElementsAre(std::array<int, 2>{0, 2}));
}

TEST(SelfIntersection, FindsAFoldThroughANeighbour) {
  // Two faces at one vertex, the far side of one pulled through the other.
  Points x(3, 5);
  x << 0, 1, 0, 0.3, 0.4,  //
      0, 0, 1, 0.3, 0.2,   //
      0, 0, 0, -0.2, 0.3;
  Faces f(3, 2);
  f << 0, 0, 1, 3, 2, 4;
  EXPECT_EQ(SelfIntersections(x, f).size(), 1u);
}

// Two spheres half a radius apart cross along a circle.
TEST(SelfIntersection, CrossingSpheres) {
  const TriangleMesh ball = Sphere(3);
  const auto n = ball.vertices.cols(), f = ball.faces.cols();
  TriangleMesh two;
  two.vertices.resize(3, 2 * n);
  two.vertices << ball.vertices, ball.vertices.colwise() + Vector3d(0.5, 0, 0);
  two.faces.resize(3, 2 * f);
  two.faces << ball.faces, ball.faces.array() + static_cast<int>(n);
  const auto pairs = SelfIntersections(two.vertices, two.faces);
  EXPECT_GT(pairs.size(), 50u);
  for (const auto& [a, b] : pairs) {
    EXPECT_LT(a, f);
    EXPECT_GE(b, f);
  }
}

}  // namespace
}  // namespace invsim
