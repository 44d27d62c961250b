// SPDX-License-Identifier: Apache-2.0
#include "invsim/geometry/mesh_editor.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "geometry/shapes.h"
#include "invsim/base/random.h"
#include "invsim/geometry/topology.h"

namespace invsim {
namespace {

using ::testing::ElementsAre;

TEST(MeshEditor, UntouchedMeshComesBack) {
  const TriangleMesh m = Sphere(1);
  const TriangleMesh r = MeshEditor(m).Compact();
  EXPECT_EQ(r.vertices, m.vertices);
  EXPECT_EQ(r.faces, m.faces);
}

TEST(MeshEditor, FindsEdges) {
  const MeshEditor m(Grid(1));  // faces (0, 1, 3), (0, 3, 2)
  const auto inner = m.FindEdge(0, 3);
  EXPECT_FALSE(inner.boundary());
  EXPECT_EQ(inner.faces[0], 1);
  EXPECT_EQ(inner.opposite[0], 2);
  EXPECT_EQ(inner.opposite[1], 1);
  EXPECT_TRUE(m.FindEdge(0, 1).boundary());
  EXPECT_FALSE(m.FindEdge(1, 2).exists());
  EXPECT_THAT(m.Neighbours(0), ElementsAre(1, 2, 3));
  EXPECT_EQ(m.EdgeList().size(), 5u);
}

TEST(MeshEditor, SplitCollapseFlipByHand) {
  MeshEditor m(Grid(1));
  const int v = m.Split(0, 3, Vector3d(0.5, 0.5, 0));
  EXPECT_EQ(v, 4);
  EXPECT_FALSE(m.OnBoundary(v));
  EXPECT_THAT(m.Neighbours(v), ElementsAre(0, 1, 2, 3));
  EXPECT_EQ(FaceAreas(m.Compact().vertices, m.Compact().faces).sum(), 1.0);
  const int edge = m.Split(0, 1, Vector3d(0.5, 0, 0));
  EXPECT_TRUE(m.OnBoundary(edge));
  EXPECT_TRUE(m.CanFlip(1, v));
  m.Flip(1, v);
  EXPECT_TRUE(m.FindEdge(edge, 3).exists());
  EXPECT_TRUE(m.CanCollapse(edge, 1));
  m.Collapse(edge, 1, Vector3d(1, 0, 0));
  const TriangleMesh r = m.Compact();
  ValidateMesh(r.vertices, r.faces, "edited");
  EXPECT_EQ(r.vertices.cols(), 5);
  EXPECT_NEAR(FaceAreas(r.vertices, r.faces).sum(), 1.0, 1e-15);
}

TEST(MeshEditor, RefusesWhatWouldSpoilTheMesh) {
  TriangleMesh tetrahedron;
  tetrahedron.vertices.resize(3, 4);
  tetrahedron.vertices << 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1;
  tetrahedron.faces.resize(3, 4);
  tetrahedron.faces << 0, 0, 0, 1, 2, 1, 3, 2, 1, 3, 2, 3;
  const MeshEditor t(tetrahedron);
  EXPECT_FALSE(t.CanCollapse(0, 1));
  EXPECT_FALSE(t.CanFlip(0, 1));  // the other diagonal is an edge already
  const MeshEditor square(Grid(1));
  EXPECT_FALSE(square.CanCollapse(0, 3));  // would pinch the boundary
  EXPECT_FALSE(square.CanFlip(0, 1));      // on the boundary
  EXPECT_FALSE(square.CanFlip(1, 2));      // no edge
}

// Thousands of random operations, each allowed by its question, keep the mesh
// a manifold of the same topology.
TEST(MeshEditor, RandomEditsKeepTheTopology) {
  for (const TriangleMesh& start : {Sphere(2), Grid(5)}) {
    MeshEditor m(start);
    Random random(9);
    int done[3] = {};
    for (int k = 0; k < 3000; ++k) {
      const auto edges = m.EdgeList();
      const auto [a, b] = edges[random.Index(static_cast<int>(edges.size()))];
      const Vector3d middle = 0.5 * (m.position(a) + m.position(b));
      const int what = random.Index(3);
      if (what == 0 && edges.size() > 500) continue;
      if (what == 1 && !m.CanCollapse(a, b)) continue;
      if (what == 2 && !m.CanFlip(a, b)) continue;
      if (what == 0) m.Split(a, b, middle);
      if (what == 1) m.Collapse(a, b, middle);
      if (what == 2) m.Flip(a, b);
      ++done[what];
    }
    for (const int count : done) EXPECT_GT(count, 200);
    const TriangleMesh r = m.Compact();
    EXPECT_EQ(EulerCharacteristic(r.faces), EulerCharacteristic(start.faces));
    EXPECT_EQ(BoundaryLoops(r.faces).size(), BoundaryLoops(start.faces).size());
    const MeshEditor again(r);
    for (int v = 0, live = 0; v < m.num_vertices(); ++v) {
      if (!m.HasVertex(v)) continue;
      EXPECT_EQ(m.OnBoundary(v), again.OnBoundary(live++));
    }
  }
}

}  // namespace
}  // namespace invsim
