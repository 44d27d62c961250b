// SPDX-License-Identifier: Apache-2.0
#include "invsim/report/frame_mesh.h"

#include <gmock/gmock.h>

#include <string>
#include <vector>

namespace invsim {
namespace {

std::vector<std::string> Names(const PlyMesh& mesh) {
  std::vector<std::string> names;
  for (const PlyProperty& p : mesh.properties) names.push_back(p.name);
  return names;
}

TEST(ClothFrame, NamesEveryQuantityAndReadsBack) {
  ClothState cloth{Points::Random(3, 4), Points::Random(3, 4)};
  Faces faces(3, 2);
  faces << 0, 0, 1, 2, 2, 3;
  const Points force = Points::Random(3, 4);
  const ClothFields fields{VectorXd::Random(4), VectorXd::Random(4)};
  const PlyMesh read =
      ParsePly(FormatPly(ClothFrame(cloth, faces, force, fields)), "frame");
  EXPECT_THAT(
      Names(read),
      testing::ElementsAre(
          "vx", "vy", "vz", "fx", "fy", "fz", "strain", "stress", "quality"));
  EXPECT_EQ(read.faces, faces);
  EXPECT_LT((*read.Find("vy") - cloth.v.row(1).transpose()).norm(), 1e-6);
  EXPECT_LT((*read.Find("fz") - force.row(2).transpose()).norm(), 1e-6);
  EXPECT_LT((*read.Find("strain") - fields.strain).norm(), 1e-6);
  EXPECT_EQ(*read.Find("quality"), *read.Find("stress"));
}

TEST(BodyFrame, HasPressure) {
  Faces faces(3, 1);
  faces << 0, 1, 2;
  const PlyMesh mesh =
      BodyFrame(Points::Random(3, 3), faces, Vector3d(1, 2, 3));
  EXPECT_THAT(Names(mesh), testing::ElementsAre("pressure", "quality"));
  EXPECT_EQ(*mesh.Find("pressure"), Vector3d(1, 2, 3));
}

}  // namespace
}  // namespace invsim
