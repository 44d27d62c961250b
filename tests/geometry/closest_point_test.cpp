// SPDX-License-Identifier: Apache-2.0
#include "invsim/geometry/closest_point.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace invsim {
namespace {

class ClosestPointTest : public ::testing::Test {
 protected:
  Vector3d Random() {
    return Vector3d(unit_(random_), unit_(random_), unit_(random_));
  }
  std::mt19937_64 random_{7};
  std::uniform_real_distribution<double> unit_{-1.0, 1.0};
};

void ExpectConsistent(const ClosestPoint& r,
                      const Vector3d& q,
                      const Vector3d& a,
                      const Vector3d& b,
                      const Vector3d& c) {
  EXPECT_NEAR(r.weights.sum(), 1.0, 1e-15);
  EXPECT_GE(r.weights.minCoeff(), 0.0);
  const Vector3d p = r.weights[0] * a + r.weights[1] * b + r.weights[2] * c;
  EXPECT_LT((p - r.point).norm(), 1e-15 * (1 + q.norm()) * 8);
  EXPECT_NEAR((q - r.point).squaredNorm(), r.squared_distance, 1e-14);
  const auto on = (r.weights.array() > 0.0).count();
  EXPECT_EQ(on, IsVertex(r.feature) ? 1 : IsEdge(r.feature) ? 2 : 3);
  if (IsVertex(r.feature)) {
    EXPECT_EQ(r.weights[FeatureCorner(r.feature)], 1.0);
  }
  if (IsEdge(r.feature)) {
    EXPECT_EQ(r.weights[FeatureCorner(r.feature)], 0.0);
  }
}

// No sampled point of the triangle is closer, and the step to the corners
// from the closest point never goes towards the query (optimality).
TEST_F(ClosestPointTest, IsOptimalForRandomTriangles) {
  int seen[7] = {};
  for (int trial = 0; trial < 5000; ++trial) {
    const Vector3d a = Random(), b = Random(), c = Random(), q = 2 * Random();
    const ClosestPoint r = ClosestPointOnTriangle(q, a, b, c);
    ExpectConsistent(r, q, a, b, c);
    for (const Vector3d& corner : {a, b, c})
      EXPECT_LT((q - r.point).dot(corner - r.point), 1e-13);
    ++seen[static_cast<int>(r.feature)];
  }
  EXPECT_GT(*std::min_element(seen, seen + 7), 100);
}

TEST_F(ClosestPointTest, KnownFeatures) {
  const Vector3d a(0, 0, 0), b(1, 0, 0), c(0, 1, 0);
  const auto feature = [&](double x, double y) {
    return ClosestPointOnTriangle(Vector3d(x, y, 0.3), a, b, c).feature;
  };
  EXPECT_EQ(feature(0.25, 0.25), TriangleFeature::kFace);
  EXPECT_EQ(feature(-1, -1), TriangleFeature::kVertex0);
  EXPECT_EQ(feature(2, 0), TriangleFeature::kVertex1);
  EXPECT_EQ(feature(0, 2), TriangleFeature::kVertex2);
  EXPECT_EQ(feature(1, 1), TriangleFeature::kEdge0);
  EXPECT_EQ(feature(-1, 0.5), TriangleFeature::kEdge1);
  EXPECT_EQ(feature(0.5, -1), TriangleFeature::kEdge2);
}

// Slivers, segments and points in place of a triangle.
TEST_F(ClosestPointTest, DegenerateTriangles) {
  for (int trial = 0; trial < 2000; ++trial) {
    const Vector3d a = Random(), b = Random(), q = Random();
    const double t = std::abs(unit_(random_));
    for (const double height : {0.0, 1e-18, 1e-14, 1e-9}) {
      const Vector3d c = a + t * (b - a) + height * Random();
      const ClosestPoint r = ClosestPointOnTriangle(q, a, b, c);
      ExpectConsistent(r, q, a, b, c);
      const double s = ClosestPointOnSegment(q, a, b);
      EXPECT_NEAR(std::sqrt(r.squared_distance),
                  (a + s * (b - a) - q).norm(),
                  1e-14 + 2 * height);
    }
    const ClosestPoint point = ClosestPointOnTriangle(q, a, a, a);
    EXPECT_EQ(point.squared_distance, (q - a).squaredNorm());
    const ClosestPoint twice = ClosestPointOnTriangle(q, a, b, b);
    ExpectConsistent(twice, q, a, b, b);
  }
}

TEST_F(ClosestPointTest, FarQueryStaysExact) {
  const Vector3d a(0, 0, 0), b(1, 0, 0), c(0, 1, 0);
  const ClosestPoint r =
      ClosestPointOnTriangle(Vector3d(0.25, 0.5, 1e8), a, b, c);
  EXPECT_EQ(r.feature, TriangleFeature::kFace);
  EXPECT_LT((r.weights - Vector3d(0.25, 0.25, 0.5)).norm(), 1e-15);
}

}  // namespace
}  // namespace invsim
