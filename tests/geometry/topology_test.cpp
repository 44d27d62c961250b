// SPDX-License-Identifier: Apache-2.0
#include "invsim/geometry/topology.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "geometry/shapes.h"
#include "invsim/base/error.h"

namespace invsim {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::StartsWith;
using ::testing::ThrowsMessage;

TEST(Topology, VertexFacesListsEveryCornerOnce) {
  const TriangleMesh m = Sphere(1);
  const VertexFaces around(m.faces, static_cast<int>(m.vertices.cols()));
  int corners = 0;
  for (int v = 0; v < m.vertices.cols(); ++v) {
    for (const int f : around[v])
      EXPECT_TRUE((m.faces.col(f).array() == v).any());
    EXPECT_TRUE(std::is_sorted(around[v].begin(), around[v].end()));
    corners += static_cast<int>(around[v].size());
  }
  EXPECT_EQ(corners, m.faces.size());
}

TEST(Topology, NeighboursShareTheSide) {
  const TriangleMesh m = Grid(3);
  const Faces beside = FaceNeighbours(m.faces);
  EXPECT_EQ((beside.array() < 0).count(), 12);
  for (int f = 0; f < m.faces.cols(); ++f) {
    for (int c = 0; c < 3; ++c) {
      const int g = beside(c, f);
      if (g < 0) continue;
      for (const int side : {(c + 1) % 3, (c + 2) % 3})
        EXPECT_TRUE((m.faces.col(g).array() == m.faces(side, f)).any());
      EXPECT_TRUE((beside.col(g).array() == f).any());
    }
  }
}

TEST(Topology, BoundaryLoopsFollowTheFaces) {
  EXPECT_THAT(BoundaryLoops(Grid(2).faces),
              ElementsAre(ElementsAre(0, 1, 2, 5, 8, 7, 6, 3)));
  EXPECT_TRUE(BoundaryLoops(UnitCube().faces).empty());
  // A cube without its top and bottom is a tube of two loops.
  const TriangleMesh cube = UnitCube();
  const Faces tube = cube.faces.rightCols(8);
  const auto loops = BoundaryLoops(tube);
  ASSERT_EQ(loops.size(), 2u);
  EXPECT_EQ(loops[0].size(), 4u);
  EXPECT_EQ(EulerCharacteristic(tube), 0);
}

TEST(Topology, LoopsThatTouchAreNamed) {
  Faces bow(3, 2);
  bow << 0, 2, 1, 3, 2, 4;
  EXPECT_THAT(
      [&] { BoundaryLoops(bow); },
      ThrowsMessage<InputError>(HasSubstr("vertex 2 lies on two boundaries")));
}

TEST(Topology, ComponentsAndEulerCharacteristic) {
  Faces two(3, 2);
  two << 1, 0, 3, 2, 5, 6;
  EXPECT_THAT(VertexComponents(two, 8), ElementsAre(0, 1, 0, 1, 2, 1, 0, 3));
  EXPECT_EQ(EulerCharacteristic(two), 2);
  EXPECT_EQ(EulerCharacteristic(Sphere(2).faces), 2);
  EXPECT_EQ(EulerCharacteristic(Grid(2).faces), 1);
}

TEST(Topology, GoodMeshesPass) {
  for (const TriangleMesh& m : {UnitCube(), Sphere(2), Grid(4)})
    EXPECT_NO_THROW(ValidateMesh(m.vertices, m.faces, "m"));
}

class BadMesh : public ::testing::Test {
 protected:
  void ExpectError(const std::string& text) {
    EXPECT_THAT([&] { ValidateMesh(m_.vertices, m_.faces, "shirt.obj"); },
                ThrowsMessage<InputError>(::testing::AllOf(
                    StartsWith("shirt.obj: "), HasSubstr(text))));
  }
  TriangleMesh m_ = Grid(2);
};

TEST_F(BadMesh, NoFaces) {
  m_.faces.resize(3, 0);
  ExpectError("no faces");
}
TEST_F(BadMesh, NotFinite) {
  m_.vertices(1, 4) = std::numeric_limits<double>::quiet_NaN();
  ExpectError("vertex 4 is not finite");
}
TEST_F(BadMesh, UnknownVertex) {
  m_.faces(2, 3) = 9;
  ExpectError("face 3 refers to vertex 9, expected 0 to 8");
}
TEST_F(BadMesh, RepeatedVertex) {
  m_.faces(1, 2) = m_.faces(0, 2);
  ExpectError("face 2 has vertex 1 twice");
}
TEST_F(BadMesh, NoArea) {
  m_.vertices.col(0) = 0.5 * (m_.vertices.col(1) + m_.vertices.col(4));
  ExpectError("face 0 (vertices 0, 1, 4) has no area");
}
TEST_F(BadMesh, UnusedVertex) {
  m_.vertices.conservativeResize(Eigen::NoChange, 10);
  m_.vertices.col(9).setZero();
  ExpectError("vertex 9 belongs to no face");
}
TEST_F(BadMesh, FlippedFace) {
  std::swap(m_.faces(0, 1), m_.faces(1, 1));
  ExpectError("runs the same way on faces");
}
TEST_F(BadMesh, ThreeFacesAtAnEdge) {
  m_.vertices.conservativeResize(Eigen::NoChange, 10);
  m_.vertices.col(9) = Vector3d(0.2, 0.3, 1);
  m_.faces.conservativeResize(Eigen::NoChange, 9);
  m_.faces.col(8) << 0, 4, 9;
  ExpectError("edge (0, 4) has 3 faces");
}
TEST_F(BadMesh, TwoFansAtAVertex) {
  m_.vertices.conservativeResize(Eigen::NoChange, 11);
  m_.vertices.col(9) = Vector3d(0, 0, 1);
  m_.vertices.col(10) = Vector3d(1, 0, 1);
  m_.faces.conservativeResize(Eigen::NoChange, 9);
  m_.faces.col(8) << 4, 9, 10;
  ExpectError("vertex 4 joins parts that share no edge");
}

}  // namespace
}  // namespace invsim
