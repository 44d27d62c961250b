// SPDX-License-Identifier: Apache-2.0
#include "invsim/fit/coverage.h"

#include <gtest/gtest.h>

#include "invsim/geometry/mesh.h"

namespace invsim {
namespace {

// A sheet 4 cm above z = 0, over 0 <= x, y <= 1.
SurfaceIndex Sheet() {
  Points v(3, 4);
  v << 0, 1, 1, 0, 0, 0, 1, 1, 0.04, 0.04, 0.04, 0.04;
  Faces f(3, 2);
  f << 0, 0, 1, 2, 2, 3;
  return SurfaceIndex(v, f);
}

TEST(CoveredVertices, AsTheRayAlongTheNormalMeetsTheCloth) {
  Points at(3, 6), normal(3, 6);
  at.col(0) = Vector3d(0.5, 0.2, 0);  // under the sheet
  normal.col(0) = Vector3d::UnitZ();
  at.col(1) = at.col(0);  // looking away
  normal.col(1) = -Vector3d::UnitZ();
  at.col(2) = Vector3d(1.5, 0.2, 0);  // beside it
  normal.col(2) = Vector3d::UnitZ();
  at.col(3) = Vector3d(0.5, 0.2, -0.2);  // too far below
  normal.col(3) = Vector3d::UnitZ();
  at.col(4) = Vector3d(0.5, 0.2, 0.042);  // the cloth lies 2 mm in the skin
  normal.col(4) = Vector3d::UnitZ();
  at.col(5) = at.col(0);  // a vertex of faces without area
  normal.col(5).setZero();
  EXPECT_EQ(CoveredVertices(at, normal, Sheet()),
            (std::vector<bool>{true, false, false, false, true, false}));
}

}  // namespace
}  // namespace invsim
