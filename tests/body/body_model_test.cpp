// SPDX-License-Identifier: Apache-2.0
#include "invsim/body/body_model.h"

#include <gmock/gmock.h>

#include "test_bodies.h"

namespace invsim {
namespace {

TEST(BodyModel, AtRestIsTheTemplate) {
  std::mt19937 rng(1);
  const BodyModelData data = RandomBodyData(40, true, &rng);
  const BodyModel model(data);
  EXPECT_EQ(model.num_vertices(), 40);
  EXPECT_EQ(model.faces(), data.faces);
  EXPECT_LT((model.Vertices({}) - data.v_template).norm(), 1e-14);
  EXPECT_LT(
      (model.Joints({}) - data.v_template * data.joint_regressor.transpose())
          .norm(),
      1e-14);
}

TEST(BodyModel, ShapeMovesVerticesAndJoints) {
  std::mt19937 rng(2);
  const BodyModelData data = RandomBodyData(40, false, &rng);
  const BodyModel model(data);
  BodyParameters p;
  p.shape(3) = 2.0;
  Points shaped = data.v_template;
  for (int i = 0; i < 40; ++i) {
    shaped.col(i) += 2.0 * data.shapedirs.block<3, 1>(3 * i, 3);
  }
  EXPECT_LT((model.Vertices(p) - shaped).norm(), 1e-14);
  EXPECT_LT(
      (model.Joints(p) - shaped * data.joint_regressor.transpose()).norm(),
      1e-14);
}

}  // namespace
}  // namespace invsim
