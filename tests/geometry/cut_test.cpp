// SPDX-License-Identifier: Apache-2.0
#include "invsim/geometry/cut.h"

#include <gtest/gtest.h>

#include <numbers>

#include "geometry/shapes.h"
#include "invsim/base/error.h"
#include "invsim/geometry/topology.h"

namespace invsim {
namespace {

TEST(Cut, HalfASphereHasHalfItsArea) {
  const TriangleMesh sphere = Sphere(4);
  const VectorXd height = sphere.vertices.row(1).array() - 0.01;
  const TriangleMesh m = CutMesh(sphere, height);
  ValidateMesh(m.vertices, m.faces, "cut");
  const auto loops = BoundaryLoops(m.faces);
  ASSERT_EQ(loops.size(), 1u);
  for (const int v : loops[0]) EXPECT_NEAR(m.vertices(1, v), 0.01, 0.01);
  EXPECT_NEAR(
      FaceAreas(m.vertices, m.faces).sum(), 2 * std::numbers::pi * 0.99, 0.05);
}

TEST(Cut, BoundaryLiesOnTheCurveUpToATenthOfAnEdge) {
  const TriangleMesh grid = Grid(10);
  const VectorXd side = grid.vertices.row(0).transpose() +
                        0.3 * grid.vertices.row(1).transpose() -
                        VectorXd::Constant(grid.vertices.cols(), 0.555);
  const TriangleMesh m = CutMesh(grid, side);
  ValidateMesh(m.vertices, m.faces, "cut");
  EXPECT_EQ(EulerCharacteristic(m.faces), 1);
  const VectorXd kept =
      m.vertices.row(0).transpose() + 0.3 * m.vertices.row(1).transpose();
  EXPECT_GT(kept.minCoeff(), 0.555 - 0.1 * 0.15);
  EXPECT_NEAR(FaceAreas(m.vertices, m.faces).sum(), 1 - 0.405, 0.01);
}

TEST(Cut, NothingAndEverything) {
  const TriangleMesh sphere = Sphere(1);
  const VectorXd one = VectorXd::Ones(sphere.vertices.cols());
  EXPECT_EQ(CutMesh(sphere, one).faces, sphere.faces);
  EXPECT_EQ(CutMesh(sphere, -one).faces.cols(), 0);
  EXPECT_THROW(CutMesh(sphere, VectorXd::Ones(3)), InputError);
}

TEST(Cut, PieceNearestKeepsOneSide) {
  const TriangleMesh sphere = Sphere(4);
  const VectorXd caps =
      sphere.vertices.row(0).cwiseAbs().transpose().array() - 0.5;
  const TriangleMesh both = CutMesh(sphere, caps);
  EXPECT_EQ(BoundaryLoops(both.faces).size(), 2u);
  const TriangleMesh right = PieceNearest(both, Vector3d(0.8, 0, 0));
  EXPECT_EQ(right.faces.cols() * 2, both.faces.cols());
  EXPECT_GT(right.vertices.row(0).minCoeff(), 0.4);
  ValidateMesh(right.vertices, right.faces, "cap");
}

}  // namespace
}  // namespace invsim
