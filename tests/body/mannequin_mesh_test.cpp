// SPDX-License-Identifier: Apache-2.0
#include "../../src/body/mannequin_mesh.h"

#include <gtest/gtest.h>

#include "invsim/geometry/topology.h"

namespace invsim {
namespace {

TEST(MannequinMesh, HalfAndImageMakeAWhole) {
  // A pyramid over the triangle (0, 0, 0), (0, 1, 0), (0, 0, 1), open there.
  TriangleMesh half;
  half.vertices.resize(3, 4);
  half.vertices << 0, 0, 0, 1, 0, 1, 0, 0, 0, 0, 1, 0;
  half.faces.resize(3, 3);
  half.faces << 0, 1, 2, 1, 2, 0, 3, 3, 3;
  const MirrorMesh whole = JoinWithMirrorImage(half);
  ASSERT_EQ(whole.mesh.vertices.cols(), 5);
  EXPECT_EQ(whole.mesh.faces.cols(), 6);
  EXPECT_EQ(whole.mirror, (std::vector<int>{0, 1, 2, 4, 3}));
  EXPECT_EQ(Vector3d(whole.mesh.vertices.col(4)), Vector3d(-1, 0, 0));
  ValidateMesh(whole.mesh.vertices, whole.mesh.faces, "double pyramid");
  EXPECT_EQ(EulerCharacteristic(whole.mesh.faces), 2);
}

}  // namespace
}  // namespace invsim
