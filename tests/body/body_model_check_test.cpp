// SPDX-License-Identifier: Apache-2.0
// Every array that does not fit is refused in one line that names it.
#include <gmock/gmock.h>

#include <limits>

#include "invsim/base/error.h"
#include "invsim/body/body_model.h"
#include "test_bodies.h"

namespace invsim {
namespace {

using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

BodyModelData Good() {
  std::mt19937 rng(1);
  return RandomBodyData(40, true, &rng);
}

struct Fault {
  const char* name;
  void (*spoil)(BodyModelData* data);
  const char* message;
};

void PrintTo(const Fault& fault, std::ostream* out) { *out << fault.name; }

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

const Fault kFaults[] = {
    {"NoVertices",
     [](BodyModelData* d) { d->v_template.resize(3, 0); },
     "b.npz: a body of 0 vertices and 38 faces"},
    {"ShapeDirections",
     [](BodyModelData* d) { d->shapedirs.resize(120, 9); },
     "b.npz: shapedirs is 120 x 9: expected 120 x 10"},
    {"PoseDirections",
     [](BodyModelData* d) { d->posedirs.resize(120, 206); },
     "b.npz: posedirs is 120 x 206: expected 120 x 207"},
    {"Regressor",
     [](BodyModelData* d) { d->joint_regressor.resize(24, 41); },
     "b.npz: J_regressor is 24 x 41: expected 24 x 40"},
    {"Weights",
     [](BodyModelData* d) { d->weights.resize(40, 52); },
     "b.npz: weights is 40 x 52: expected 40 x 24"},
    {"NotANumber",
     [](BodyModelData* d) { d->v_template(1, 2) = kNan; },
     "b.npz: v_template holds nan (value 7): expected finite numbers"},
    {"WeightsNotFinite",
     [](BodyModelData* d) { d->weights(0, 0) = kNan; },
     "b.npz: weights holds nan (value 0): expected finite numbers"},
    {"WeightSum",
     [](BodyModelData* d) { d->weights.row(5) *= 0.5; },
     "b.npz: weights: row 5 sums to 0.500000: expected 1"},
    {"NegativeWeight",
     [](BodyModelData* d) {
       d->weights.row(3).setZero();
       d->weights(3, 0) = 1.25;
       d->weights(3, 1) = -0.25;
     },
     "b.npz: weights: row 3 holds -0.250000: expected no negative weight"},
    {"RegressorSum",
     [](BodyModelData* d) { d->joint_regressor.row(2).setZero(); },
     "b.npz: J_regressor: row 2 sums to 0.000000: expected 1"},
    {"JointCount",
     [](BodyModelData* d) { d->parents.resize(22); },
     "b.npz: kintree_table has 22 joints: expected the 24 of SMPL"},
    {"TwoRoots",
     [](BodyModelData* d) { d->parents[4] = -1; },
     "b.npz: kintree_table: joint 4 has parent -1: expected a joint before "
     "it, 0 to 3"},
    {"ParentAfterChild",
     [](BodyModelData* d) { d->parents[4] = 7; },
     "b.npz: kintree_table: joint 4 has parent 7: expected a joint before it, "
     "0 to 3"},
    {"RootWithParent",
     [](BodyModelData* d) { d->parents[0] = 0; },
     "b.npz: kintree_table: joint 0 has parent 0: expected -1 (the root)"},
    {"FaceVertex",
     [](BodyModelData* d) { d->faces(2, 1) = 40; },
     "b.npz: f: face 1 names vertex 40: expected 0 to 39"},
    {"NegativeFaceVertex",
     [](BodyModelData* d) { d->faces(0, 0) = -1; },
     "b.npz: f: face 0 names vertex -1: expected 0 to 39"}};

class BodyModelFault : public ::testing::TestWithParam<Fault> {};

TEST_P(BodyModelFault, IsRefusedInOneLine) {
  BodyModelData data = Good();
  GetParam().spoil(&data);
  EXPECT_THAT([&] { BodyModel(data, "b.npz"); },
              ThrowsMessage<InputError>(HasSubstr(GetParam().message)));
}

INSTANTIATE_TEST_SUITE_P(All,
                         BodyModelFault,
                         ::testing::ValuesIn(kFaults),
                         [](const auto& param) {
                           return std::string(param.param.name);
                         });

// Sums that miss one as those of 32-bit files do are scaled away.
TEST(BodyModelCheck, SmallMissesOfSumsAreScaledAway) {
  BodyModelData data = Good();
  data.weights *= 1.001;
  data.weights(0, 0) -= 1e-6;
  data.joint_regressor *= 0.999;
  const BodyModel model(data);
  EXPECT_LT(
      (model.data().weights.rowwise().sum().array() - 1.0).abs().maxCoeff(),
      1e-15);
  EXPECT_GE(model.data().weights.minCoeff(), 0.0);
  // Hence a shifted body is a shifted body.
  BodyModelData shifted = data;
  shifted.v_template.colwise() += Vector3d(0, 5, 0);
  const Points moved = BodyModel(shifted).Vertices({}) - model.Vertices({});
  EXPECT_LT((moved.colwise() - Vector3d(0, 5, 0)).cwiseAbs().maxCoeff(), 1e-14);
}

TEST(BodyModelCheck, ZeroPoseDirectionsAreDropped) {
  BodyModelData data = Good();
  data.posedirs.setZero();
  EXPECT_EQ(BodyModel(data).data().posedirs.size(), 0);
  EXPECT_GT(BodyModel(Good()).data().posedirs.size(), 0);
}

}  // namespace
}  // namespace invsim
