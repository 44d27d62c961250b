// SPDX-License-Identifier: Apache-2.0
#include "invsim/geometry/sampling.h"

#include <gtest/gtest.h>

#include <cmath>

#include "geometry/shapes.h"
#include "invsim/base/error.h"

namespace invsim {
namespace {

// Faces of very different area get samples in proportion, within five standard
// deviations of the binomial.
TEST(Sampling, IsUniformByArea) {
  TriangleMesh m = Grid(1);
  m.vertices(0, 3) = 4.0;
  m.vertices(1, 3) = 2.0;
  const VectorXd areas = FaceAreas(m.vertices, m.faces);
  constexpr int kCount = 20000;
  Random random(3);
  const auto samples = SampleSurface(m.vertices, m.faces, kCount, &random);
  int first = 0;
  for (const auto& s : samples) first += s.face == 0 ? 1 : 0;
  const double p = areas[0] / areas.sum();
  EXPECT_NEAR(first, kCount * p, 5 * std::sqrt(kCount * p * (1 - p)));
}

// The mean of uniform points in a triangle is its centroid, and their second
// moment that of the triangle: E[w_i^2] = 1/6, E[w_i w_j] = 1/12.
TEST(Sampling, IsUniformWithinAFace) {
  const TriangleMesh m = Grid(1);
  Random random(4);
  const int count = 40000;
  Matrix3d moment = Matrix3d::Zero();
  Vector3d mean = Vector3d::Zero();
  for (const auto& s : SampleSurface(m.vertices, m.faces, count, &random)) {
    EXPECT_NEAR(s.weights.sum(), 1.0, 1e-15);
    EXPECT_GE(s.weights.minCoeff(), 0.0);
    mean += s.weights / count;
    moment += s.weights * s.weights.transpose() / count;
  }
  EXPECT_LT((mean - Vector3d::Constant(1.0 / 3)).norm(), 0.005);
  const Matrix3d expected =
      Matrix3d::Constant(1.0 / 12) + Matrix3d::Identity() / 12.0;
  EXPECT_LT((moment - expected).norm(), 0.005);
}

TEST(Sampling, PositionsLieOnTheSurfaceAndTheSeedDecides) {
  const TriangleMesh m = Grid(3);
  Random a(5), b(5), c(6);
  const auto p = SamplePositions(
      m.vertices, m.faces, SampleSurface(m.vertices, m.faces, 100, &a));
  const auto q = SamplePositions(
      m.vertices, m.faces, SampleSurface(m.vertices, m.faces, 100, &b));
  const auto r = SamplePositions(
      m.vertices, m.faces, SampleSurface(m.vertices, m.faces, 100, &c));
  EXPECT_EQ(p, q);
  EXPECT_NE(p, r);
  EXPECT_EQ(p.row(2).norm(), 0.0);
  EXPECT_GE(p.minCoeff(), 0.0);
  EXPECT_LE(p.maxCoeff(), 1.0);
}

TEST(Sampling, NoAreaIsRefused) {
  Random random(1);
  EXPECT_THROW(SampleSurface(Points(3, 0), Faces(3, 0), 1, &random),
               InputError);
  EXPECT_THROW(
      SampleSurface(Points::Zero(3, 3), Eigen::Vector3i(0, 1, 2), 1, &random),
      InputError);
}

}  // namespace
}  // namespace invsim
