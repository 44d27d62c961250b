// SPDX-License-Identifier: Apache-2.0
#ifndef INVSIM_TESTS_BODY_TEST_BODIES_H_
#define INVSIM_TESTS_BODY_TEST_BODIES_H_

// Bodies of random numbers for tests: nothing about them is human but the tree
// of joints, so that no symmetry hides a mistake.

#include <cmath>
#include <random>

#include "invsim/body/body_model.h"

namespace invsim {

inline MatrixXd RandomMatrix(Eigen::Index rows,
                             Eigen::Index cols,
                             double scale,
                             std::mt19937* rng) {
  std::normal_distribution<double> normal(0.0, scale);
  MatrixXd m(rows, cols);
  for (Eigen::Index k = 0; k < m.size(); ++k) m.data()[k] = normal(*rng);
  return m;
}

// SMPL's tree.
inline std::vector<int> SmplParents() {
  return {-1, 0, 0, 0,  1,  2,  3,  4,  5,  6,  7,  8,
          9,  9, 9, 12, 13, 14, 16, 17, 18, 19, 20, 21};
}

// `count` vertices with up to four influences each; with_posedirs adds pose
// blend shapes.
inline BodyModelData RandomBodyData(int count,
                                    bool with_posedirs,
                                    std::mt19937* rng) {
  BodyModelData data;
  data.v_template = RandomMatrix(3, count, 0.5, rng);
  data.shapedirs = RandomMatrix(3 * count, kNumShape, 0.05, rng);
  if (with_posedirs) {
    data.posedirs = RandomMatrix(3 * count, kNumPoseFeatures, 0.02, rng);
  }
  data.joint_regressor = MatrixXd::Zero(kNumJoints, count);
  data.weights = MatrixXd::Zero(count, kNumJoints);
  for (int j = 0; j < kNumJoints; ++j) {
    for (int k = 0; k < 5; ++k) {
      data.joint_regressor(j, (*rng)() % count) += 0.2;
    }
  }
  for (int i = 0; i < count; ++i) {
    for (int k = 0; k < 4; ++k) data.weights(i, (*rng)() % kNumJoints) += 0.25;
  }
  data.parents = SmplParents();
  data.faces.resize(3, count - 2);
  for (int f = 0; f < count - 2; ++f) data.faces.col(f) << f, f + 1, f + 2;
  return data;
}

inline BodyParameters RandomParameters(double pose_scale, std::mt19937* rng) {
  BodyParameters p;
  p.shape = RandomMatrix(kNumShape, 1, 1.0, rng);
  p.pose = RandomMatrix(kNumPose, 1, pose_scale, rng);
  p.translation = RandomMatrix(3, 1, 1.0, rng);
  return p;
}

}  // namespace invsim

#endif  // INVSIM_TESTS_BODY_TEST_BODIES_H_
