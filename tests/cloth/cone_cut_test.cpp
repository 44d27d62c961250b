// SPDX-License-Identifier: Apache-2.0
#include "invsim/cloth/cone_cut.h"

#include <gtest/gtest.h>

#include <numbers>

#include "geometry/shapes.h"
#include "invsim/geometry/cut.h"
#include "invsim/geometry/topology.h"

namespace invsim {
namespace {

ConeCut Neck(double slope) {
  return ConeCut(Vector3d(0, 1, 0),
                 Vector3d(0, 2, 0),
                 Vector3d(0, 5, 3),  // +z once made normal to the axis
                 {{{-0.1, 0.4}, {0.0, 0.2}, {-0.02, 0.3}, {0.0, 0.25}}},
                 slope);
}

TEST(ConeCut, CurveGoesThroughTheAnchors) {
  const ConeCut cut = Neck(1.0);
  const double right = std::numbers::pi / 2;
  EXPECT_LT((cut.Curve(0) - Vector3d(0, 0.9, 0.4)).norm(), 1e-15);
  EXPECT_LT((cut.Curve(right) - Vector3d(0.2, 1.0, 0)).norm(), 1e-15);
  EXPECT_LT((cut.Curve(2 * right) - Vector3d(0, 0.98, -0.3)).norm(), 1e-15);
  EXPECT_LT((cut.Curve(3 * right) - Vector3d(-0.25, 1.0, 0)).norm(), 1e-15);
}

TEST(ConeCut, IsZeroOnTheCurveAndKeepsWhatIsBelow) {
  for (const double slope : {0.2, 1.0}) {
    const ConeCut cut = Neck(slope);
    for (int k = 0; k < 50; ++k) {
      const Vector3d on = cut.Curve(0.13 * k);
      EXPECT_NEAR(cut.Value(on), 0.0, 1e-14);
      EXPECT_NEAR(cut.Value(on + Vector3d(0, 0.1, 0)), -0.1, 1e-14);
      EXPECT_NEAR(cut.Value(on - Vector3d(0, 0.1, 0)), 0.1, 1e-14);
      const Vector3d out = 0.1 * Vector3d(on[0], 0, on[2]).normalized();
      EXPECT_NEAR(cut.Value(on + out), 0.1 * slope, 1e-14);
    }
    EXPECT_LT(cut.Value(Vector3d(0, 2, 0)), 0.0);
  }
}

// A hole in the top of a sphere: one piece, one opening, at the curve.
TEST(ConeCut, CutsAnOpening) {
  const TriangleMesh sphere = Sphere(4);
  const ConeCut cut(Vector3d(0, 0, 0),
                    Vector3d(0, 1, 0),
                    Vector3d(0, 0, 1),
                    {{{0.6, 0.8}, {0.8, 0.6}, {0.8, 0.6}, {0.8, 0.6}}},
                    1.0);
  VectorXd values(sphere.vertices.cols());
  for (int v = 0; v < values.size(); ++v)
    values[v] = cut.Value(sphere.vertices.col(v));
  const TriangleMesh m = CutMesh(sphere, values);
  const auto loops = BoundaryLoops(m.faces);
  ASSERT_EQ(loops.size(), 1u);
  double front = 1.0, back = 1.0;
  for (const int v : loops[0]) {
    if (m.vertices(2, v) > 0.7) front = m.vertices(1, v);
    if (m.vertices(2, v) < -0.55) back = m.vertices(1, v);
  }
  EXPECT_NEAR(front, 0.6, 0.05);
  EXPECT_NEAR(back, 0.8, 0.05);
}

}  // namespace
}  // namespace invsim
