// SPDX-License-Identifier: Apache-2.0
#include "invsim/geometry/remesh.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <numbers>

#include "geometry/shapes.h"
#include "invsim/base/error.h"
#include "invsim/geometry/surface_index.h"
#include "invsim/geometry/topology.h"

namespace invsim {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

double MeanEdge(const TriangleMesh& m) {
  double sum = 0.0;
  const auto edges = Edges(m.faces);
  for (const Edge& e : edges)
    sum += (m.vertices.col(e.a) - m.vertices.col(e.b)).norm();
  return sum / static_cast<double>(edges.size());
}

double Volume(const TriangleMesh& m) {
  double volume = 0.0;
  for (int f = 0; f < m.faces.cols(); ++f) {
    Matrix3d corners;
    for (int c = 0; c < 3; ++c) corners.col(c) = m.vertices.col(m.faces(c, f));
    volume += corners.determinant() / 6.0;
  }
  return volume;
}

void ExpectGood(const TriangleMesh& m,
                const TriangleMesh& of,
                double edge_length) {
  ValidateMesh(m.vertices, m.faces, "remeshed");
  EXPECT_EQ(EulerCharacteristic(m.faces), EulerCharacteristic(of.faces));
  EXPECT_EQ(BoundaryLoops(m.faces).size(), BoundaryLoops(of.faces).size());
  const VectorXd angles = SmallestAngles(m.vertices, m.faces);
  EXPECT_GT(angles.minCoeff(), 25 * kDegree);
  EXPECT_GT(angles.mean(), 48 * kDegree);
  EXPECT_NEAR(MeanEdge(m) / edge_length, 1.0, 0.12);
}

TEST(Remesh, SphereFinerAndCoarser) {
  const TriangleMesh sphere = Sphere(4);
  const SurfaceIndex surface(sphere.vertices, sphere.faces);
  for (const double length : {0.06, 0.15, 0.3}) {
    const TriangleMesh m = Remesh(sphere, length);
    ExpectGood(m, sphere, length);
    for (const SurfacePoint& p : surface.NearestAll(m.vertices))
      EXPECT_LT(p.distance, 1e-3);
    // Outward as before: the volume differs by the chords only.
    EXPECT_NEAR(Volume(m), Volume(sphere), std::numbers::pi * length * length);
  }
}

// A sheet keeps its corners, its outline and its area.
TEST(Remesh, SheetResamplesItsBoundary) {
  const TriangleMesh sheet = Grid(6);
  const TriangleMesh m = Remesh(sheet, 0.07);
  ExpectGood(m, sheet, 0.07);
  EXPECT_NEAR(FaceAreas(m.vertices, m.faces).sum(), 1.0, 1e-12);
  EXPECT_LT(m.vertices.row(2).cwiseAbs().maxCoeff(), 1e-15);
  const auto loops = BoundaryLoops(m.faces);
  for (const int v : loops[0]) {
    const double x = m.vertices(0, v), y = m.vertices(1, v);
    EXPECT_LT(std::min({x, y, 1 - x, 1 - y}), 1e-12);
  }
}

TEST(Remesh, KeepsTheBoundaryIfAsked) {
  const TriangleMesh sheet = Grid(6);
  RemeshOptions options;
  options.keep_boundary = true;
  const TriangleMesh m = Remesh(sheet, 0.08, options);
  ValidateMesh(m.vertices, m.faces, "remeshed");
  const auto before = BoundaryLoops(sheet.faces)[0];
  const auto after = BoundaryLoops(m.faces)[0];
  ASSERT_EQ(before.size(), after.size());
  for (size_t i = 0; i < before.size(); ++i)
    EXPECT_EQ(Vector3d(m.vertices.col(after[i])),
              Vector3d(sheet.vertices.col(before[i])));
  EXPECT_GT(m.vertices.cols(), sheet.vertices.cols());
}

// A tube: two boundary circles stay where they are.
TEST(Remesh, TubeKeepsItsRims) {
  TriangleMesh tube = Grid(24);
  const int n = 25;
  // Close the sheet along x: column 24 becomes column 0.
  for (int k = 0; k < tube.faces.size(); ++k)
    if (tube.faces(k) % n == n - 1) tube.faces(k) -= n - 1;
  for (int i = 0; i < tube.vertices.cols(); ++i) {
    const double angle = 2 * std::numbers::pi * tube.vertices(0, i);
    const double height = tube.vertices(1, i);
    tube.vertices.col(i) << std::cos(angle), height, -std::sin(angle);
  }
  const TriangleMesh start = Remesh(tube, 0.12);
  const TriangleMesh m = Remesh(start, 0.2);
  ExpectGood(m, start, 0.2);
  const auto loops = BoundaryLoops(m.faces);
  ASSERT_EQ(loops.size(), 2u);
  for (const auto& loop : loops)
    for (const int v : loop)
      EXPECT_LT(std::min(m.vertices(1, v), 1 - m.vertices(1, v)), 1e-9);
}

TEST(Remesh, FollowsTheLengthField) {
  const auto field = [](const Vector3d& x) { return 0.04 + 0.08 * x[0]; };
  const TriangleMesh m = Remesh(Grid(10), field);
  ValidateMesh(m.vertices, m.faces, "remeshed");
  for (const Edge& e : Edges(m.faces)) {
    const Vector3d a = m.vertices.col(e.a), b = m.vertices.col(e.b);
    const double ratio = (a - b).norm() / field(0.5 * (a + b));
    EXPECT_GT(ratio, 0.5);
    EXPECT_LT(ratio, 1.7);
  }
}

TEST(Remesh, IsRepeatable) {
  const TriangleMesh sphere = Sphere(3);
  EXPECT_EQ(Remesh(sphere, 0.2).vertices, Remesh(sphere, 0.2).vertices);
}

TEST(Remesh, SmallestAnglesAreKnown) {
  Points x(3, 3);
  x << 0, 1, 0, 0, 0, std::sqrt(3.0), 0, 0, 0;
  EXPECT_NEAR(
      SmallestAngles(x, Eigen::Vector3i(0, 1, 2))[0], 30 * kDegree, 1e-15);
}

TEST(Remesh, RefusesAnEdgeLengthThatIsNone) {
  EXPECT_THROW(Remesh(Grid(1), 0.0), InputError);
  EXPECT_THROW(Remesh(Grid(1), std::nan("")), InputError);
}

}  // namespace
}  // namespace invsim
