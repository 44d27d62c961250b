// SPDX-License-Identifier: Apache-2.0
#include "invsim/geometry/point_normals.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "invsim/base/random.h"

namespace invsim {
namespace {

TEST(EstimateNormals, OfAPlaneIsItsOwn) {
  Random random(1);
  const Vector3d normal = Vector3d(1, 2, -0.5).normalized();
  const Vector3d a = normal.unitOrthogonal(), b = normal.cross(a);
  Points points(3, 300);
  for (int i = 0; i < points.cols(); ++i)
    points.col(i) = random.Uniform() * a + random.Uniform() * b;
  const Points normals = EstimateNormals(KdTree(points));
  for (int i = 0; i < points.cols(); ++i)
    EXPECT_NEAR(std::abs(normals.col(i).dot(normal)), 1, 1e-12);
}

TEST(EstimateNormals, OfASphereIsTheRadius) {
  Random random(2);
  Points points(3, 4000);
  for (int i = 0; i < points.cols(); ++i) {
    Vector3d p;
    for (double& value : p) value = random.Normal();
    points.col(i) = p.normalized();
  }
  const Points normals = EstimateNormals(KdTree(points));
  for (int i = 0; i < points.cols(); ++i)
    EXPECT_GT(std::abs(normals.col(i).dot(points.col(i))), 0.98);
}

TEST(EstimateNormals, FewPointsAndEqualOnesHaveSomeUnitNormal) {
  const Points normals = EstimateNormals(KdTree(Points::Ones(3, 5)));
  for (int i = 0; i < 5; ++i) EXPECT_NEAR(normals.col(i).norm(), 1, 1e-12);
}

}  // namespace
}  // namespace invsim
