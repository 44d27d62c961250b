// SPDX-License-Identifier: Apache-2.0
#include "invsim/study/visible_surface.h"

#include <gtest/gtest.h>

#include "geometry/shapes.h"

namespace invsim {
namespace {

TEST(FindVisibleSurface, DropsFacesWithACoveredVertex) {
  const TriangleMesh cube = UnitCube();
  // A sheet of two faces 5 cm above one top corner (1, 1, 1) of the cube,
  // where the vertex normal points along the diagonal.
  Points sheet(3, 4);
  sheet << 0.9, 1.2, 1.2, 0.9, 1.05, 1.05, 1.05, 1.05, 0.9, 0.9, 1.2, 1.2;
  Faces faces(3, 2);
  faces << 0, 0, 1, 2, 2, 3;
  const SurfaceIndex index(sheet, faces);
  const VisibleSurface s = FindVisibleSurface(cube, index);
  EXPECT_EQ(s.cloth_faces, 2);
  int meeting = 0;  // faces of the cube at that corner
  for (int f = 0; f < 12; ++f)
    meeting += (cube.faces.col(f).array() == 7).any();
  EXPECT_EQ(s.mesh.faces.cols(), 2 + 12 - meeting);
  EXPECT_EQ(s.mesh.vertices.cols(), 4 + 7);
  EXPECT_EQ(s.mesh.vertices.leftCols(4), sheet);
  // What is left lies where it was.
  EXPECT_NEAR(FaceAreas(s.mesh.vertices, s.mesh.faces).sum(),
              0.09 + 0.5 * (12 - meeting),
              1e-12);
}

TEST(FindVisibleSurface, AClothThatHidesAllLeavesTheClothAlone) {
  const TriangleMesh cube = UnitCube();
  const Points around = ((1.05 * (cube.vertices.array() - 0.5)) + 0.5).matrix();
  const VisibleSurface s =
      FindVisibleSurface(cube, SurfaceIndex(around, cube.faces));
  EXPECT_EQ(s.mesh.faces, cube.faces);
  EXPECT_EQ(s.mesh.vertices, around);
}

}  // namespace
}  // namespace invsim
