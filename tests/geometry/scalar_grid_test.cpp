// SPDX-License-Identifier: Apache-2.0
#include "invsim/geometry/scalar_grid.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>

#include "invsim/base/error.h"
#include "invsim/base/random.h"
#include "invsim/geometry/remesh.h"
#include "invsim/geometry/topology.h"

namespace invsim {
namespace {

ScalarGrid Fill(double cell, const std::function<double(const Vector3d&)>& f) {
  ScalarGrid grid(Vector3d(-1.3, -1.25, -1.2), Vector3d(1.3, 1.25, 1.2), cell);
  for (int k = 0; k < grid.size()[2]; ++k)
    for (int j = 0; j < grid.size()[1]; ++j)
      for (int i = 0; i < grid.size()[0]; ++i)
        grid.value(grid.Node(i, j, k)) = f(grid.Position(i, j, k));
  return grid;
}

TEST(ScalarGrid, SamplesLinearFieldsExactly) {
  const Vector3d slope(0.3, -1.2, 2.0);
  const ScalarGrid grid =
      Fill(0.17, [&](const Vector3d& x) { return slope.dot(x) - 0.4; });
  Random random(1);
  for (int k = 0; k < 100; ++k) {
    const Vector3d x(
        random.Uniform(-1, 1), random.Uniform(-1, 1), random.Uniform(-1, 1));
    EXPECT_NEAR(grid.Sample(x), slope.dot(x) - 0.4, 1e-13);
    EXPECT_LT((grid.Gradient(x) - slope).norm(), 1e-12);
  }
  EXPECT_EQ(grid.Sample(Vector3d(-9, 0, 0)), grid.Sample(Vector3d(-1.3, 0, 0)));
}

TEST(ScalarGrid, FillsExactlyNearZeroAndTheSignElsewhere) {
  const auto ball = [](const Vector3d& x) { return x.norm() - 0.8; };
  const ScalarGrid all = Fill(0.04, ball);
  ScalarGrid grid(Vector3d(-1.3, -1.25, -1.2), Vector3d(1.3, 1.25, 1.2), 0.04);
  ASSERT_EQ(grid.num_nodes(), all.num_nodes());
  grid.Fill(ball, 0.1);
  int exact = 0;
  for (int n = 0; n < grid.num_nodes(); ++n) {
    EXPECT_EQ(grid.value(n) < 0.0, all.value(n) < 0.0);
    if (std::abs(all.value(n)) < 0.1) {
      EXPECT_EQ(grid.value(n), all.value(n));
    }
    exact += grid.value(n) == all.value(n) ? 1 : 0;
  }
  EXPECT_LT(exact, grid.num_nodes() / 2);
}

TEST(ScalarGrid, SphereSurfaceIsClosedOutwardAndInPlace) {
  const double cell = 0.1;
  const TriangleMesh m =
      ZeroSurface(Fill(cell, [](const Vector3d& x) { return x.norm() - 1.0; }));
  ValidateMesh(m.vertices, m.faces, "sphere");
  EXPECT_EQ(EulerCharacteristic(m.faces), 2);
  EXPECT_TRUE(BoundaryLoops(m.faces).empty());
  const Points n = FaceNormals(m.vertices, m.faces);
  const VectorXd areas = FaceAreas(m.vertices, m.faces);
  double along = 0.0;
  for (int f = 0; f < m.faces.cols(); ++f) {
    const double cosine = n.col(f).dot(m.vertices.col(m.faces(0, f)));
    EXPECT_GT(cosine, 0.0);
    along += areas[f] * cosine;
  }
  EXPECT_GT(along / areas.sum(), 0.97);
  for (int v = 0; v < m.vertices.cols(); ++v)
    EXPECT_NEAR(m.vertices.col(v).norm(), 1.0, 0.2 * cell);
}

// Random values make every case of every tetrahedron.
TEST(ScalarGrid, AnyFieldGivesAManifold) {
  Random random(2);
  const TriangleMesh m = ZeroSurface(Fill(0.2, [&](const Vector3d& x) {
    return x.cwiseAbs().maxCoeff() > 1.05 ? 1.0 : random.Uniform(-1, 1);
  }));
  ValidateMesh(m.vertices, m.faces, "noise");
  EXPECT_TRUE(BoundaryLoops(m.faces).empty());
  EXPECT_GT(m.faces.cols(), 10000);
}

TEST(ScalarGrid, SurfaceMayLeaveTheBox) {
  const TriangleMesh m = ZeroSurface(Fill(
      0.1, [](const Vector3d& x) { return std::hypot(x[0], x[2]) - 0.7; }));
  ValidateMesh(m.vertices, m.faces, "tube");
  EXPECT_EQ(BoundaryLoops(m.faces).size(), 2u);
}

// A Gaussian averages a wave of wave number w down by exp(-sigma^2 w^2 / 2).
TEST(ScalarGrid, SmoothingIsGaussian) {
  const double w = 4.0, sigma = 0.15;
  ScalarGrid grid =
      Fill(0.05, [&](const Vector3d& x) { return std::sin(w * x[1]); });
  grid.Smooth(sigma);
  const Vector3d x(0.1, 0.3, -0.2);
  EXPECT_NEAR(grid.Sample(x),
              std::sin(w * x[1]) * std::exp(-0.5 * sigma * sigma * w * w),
              0.01);
}

TEST(ScalarGrid, RefusesUnusableBoxes) {
  const Vector3d o = Vector3d::Zero(), e = Vector3d::Ones();
  EXPECT_THROW(ScalarGrid(o, e, 0.0), UsageError);
  EXPECT_THROW(ScalarGrid(e, o, 0.1), UsageError);
  EXPECT_THROW(ScalarGrid(o, e, 1e-4), UsageError);
}

}  // namespace
}  // namespace invsim
