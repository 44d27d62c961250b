// SPDX-License-Identifier: Apache-2.0
#ifndef INVSIM_FIT_PRIORS_H_
#define INVSIM_FIT_PRIORS_H_

// What is known before any point is measured. Each is a sum of squares
// 1/2 (lambda / n) |r|^2-like terms in natural units:
//
//   smoothness   joints: |a|^2 / s^2 with the second difference of rotations
//                  a_t = Log(R_t^T R_{t+1}) - Log(R_{t-1}^T R_t);
//                pelvis: the second difference of t. The paper's Laplacian
//                (its L_t), but of rotations: a vector that wraps costs
//                nothing.
//   shape        |beta|^2: a body model's coefficients are N(0, 1). Its weight
//                  is that of many frames, for what hides the shape, cloth that
//                  lies otherwise than simulated, hides it alike in all.
//   pose         limits of the joints and their usual range (table in
//                pose_prior.cpp), so that limbs which few points see do not
//                fold.
//   overlap      |d|^2 / s^2, d the depths of body parts in each other
//                (body_overlap.h). Off unless asked for.

#include <array>

#include "invsim/base/options.h"
#include "invsim/body/body_model.h"

namespace invsim {

struct PriorOptions {
  double smoothness = 1;
  // Usual second differences, one standard deviation, per frame squared.
  double turn = 0.03;   // rad
  double shift = 0.01;  // m
  double shape = 100;
  double pose = 1;
  double overlap = 0;
  double depth = 0.01;  // m, the overlap's standard deviation
};
void Describe(OptionTable* table, PriorOptions* options);

// Second difference of the rotations of three frames, 72, and its derivative
// by each frame's pose: block diagonal, element 3 f + ... of joint j.
struct RotationLaplacian {
  PoseVector value;
  // [frame][joint]: d value(joint) / d theta(frame, joint).
  std::array<std::array<Matrix3d, kNumJoints>, 3> derivative;
};
RotationLaplacian LaplacianOfRotations(const PoseVector& before,
                                       const PoseVector& here,
                                       const PoseVector& after);

// Two rows per angle of joints 1 to 23: how far it is outside its limits, and
// how far from its usual value; in standard deviations.
inline constexpr int kNumPosePrior = 2 * (kNumPose - 3);
using PosePriorVector = Eigen::Matrix<double, kNumPosePrior, 1>;
// `slope` is the derivative of each row by its own angle, 3 + row / 2.
PosePriorVector PosePrior(const PoseVector& pose, PosePriorVector* slope);

}  // namespace invsim

#endif  // INVSIM_FIT_PRIORS_H_
