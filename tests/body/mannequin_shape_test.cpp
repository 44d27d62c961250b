// SPDX-License-Identifier: Apache-2.0
#include "../../src/body/mannequin_shape.h"

#include <gtest/gtest.h>

namespace invsim {
namespace {

class MannequinShapes : public ::testing::TestWithParam<int> {
 protected:
  Vector3d At(const Vector3d& x) const {
    return MannequinShapeDisplacement(static_cast<MannequinShape>(GetParam()),
                                      x);
  }
};

TEST_P(MannequinShapes, MirrorImagesMoveAlike) {
  const Points rest = Mannequin().Vertices({});
  for (Eigen::Index i = 0; i < rest.cols(); i += 7) {
    const Vector3d x = rest.col(i);
    const Vector3d mirrored = At({-x.x(), x.y(), x.z()});
    EXPECT_EQ(At(x), Vector3d(-mirrored.x(), mirrored.y(), mirrored.z()));
  }
}

// Smooth: over a centimetre nothing moves more than 4 mm differently, and
// across the middle there is no jump.
TEST_P(MannequinShapes, NeighboursMoveAlike) {
  const Points rest = Mannequin().Vertices({});
  for (Eigen::Index i = 0; i < rest.cols(); ++i) {
    for (int c = 0; c < 3; ++c) {
      const Vector3d x = rest.col(i);
      EXPECT_LT((At(x + 0.01 * Vector3d::Unit(c)) - At(x)).norm(), 0.004)
          << x.transpose();
    }
  }
  EXPECT_LT(At({1e-9, -.5, .05}).x() - At({-1e-9, -.5, .05}).x(), 1e-6);
}

INSTANTIATE_TEST_SUITE_P(All,
                         MannequinShapes,
                         ::testing::Range(0, kNumShape),
                         [](const auto& param) {
                           return std::string(
                               kMannequinShapes[param.param].name);
                         });

}  // namespace
}  // namespace invsim
