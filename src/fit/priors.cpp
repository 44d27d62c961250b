// SPDX-License-Identifier: Apache-2.0
#include "invsim/fit/priors.h"

#include <Eigen/LU>
#include <algorithm>

#include "invsim/body/rotation.h"

namespace invsim {
namespace {

// Angles in radians about x (left), y (up) and z (front) away from the T pose,
// in the frame of the joint's parent.
struct JointRange {
  Vector3d low;
  Vector3d high;
  Vector3d usual;
  Vector3d spread;  // one standard deviation
};

// Degree of certainty of a limit: so much beyond it is one deviation.
constexpr double kLimitSpread = 0.05;

// The right side's range: y and z change sign.
JointRange Mirrored(const JointRange& left) {
  JointRange right = left;
  for (int c = 1; c < 3; ++c) {
    right.low[c] = -left.high[c];
    right.high[c] = -left.low[c];
    right.usual[c] = -left.usual[c];
  }
  return right;
}

using V = Vector3d;

std::array<JointRange, kNumJoints> MakeRanges() {
  const JointRange hip{V(-2.2, -1.0, -0.6),
                       V(0.9, 1.0, 1.2),
                       V(-0.2, 0, 0.05),
                       V(0.6, 0.3, 0.3)};
  const JointRange knee{
      V(-0.1, -0.4, -0.3), V(2.6, 0.4, 0.3), V(0.3, 0, 0), V(0.8, 0.2, 0.15)};
  const JointRange ankle{
      V(-0.9, -0.6, -0.6), V(0.9, 0.6, 0.6), V(0, 0, 0), V(0.35, 0.25, 0.25)};
  const JointRange foot{
      V(-0.6, -0.3, -0.3), V(0.6, 0.3, 0.3), V(0, 0, 0), V(0.2, 0.1, 0.1)};
  const JointRange spine{
      V(-0.6, -0.7, -0.5), V(0.9, 0.7, 0.5), V(0.05, 0, 0), V(0.25, 0.2, 0.2)};
  const JointRange neck{
      V(-0.8, -1.0, -0.6), V(0.9, 1.0, 0.6), V(0, 0, 0), V(0.35, 0.35, 0.25)};
  const JointRange collar{
      V(-0.4, -0.6, -0.7), V(0.4, 0.6, 0.7), V(0, 0, 0), V(0.2, 0.2, 0.25)};
  const JointRange shoulder{V(-1.8, -2.0, -1.9),
                            V(1.8, 1.6, 1.7),
                            V(0, -0.1, -0.8),
                            V(0.8, 0.8, 0.9)};
  const JointRange elbow{
      V(-1.6, -2.7, -0.6), V(1.6, 0.15, 0.6), V(0, -0.5, 0), V(0.6, 0.8, 0.25)};
  const JointRange wrist{
      V(-1.3, -1.0, -1.3), V(1.3, 1.0, 1.3), V(0, 0, 0), V(0.4, 0.3, 0.4)};
  const JointRange hand{
      V(-0.3, -0.3, -0.3), V(0.3, 0.3, 0.3), V(0, 0, 0), V(0.1, 0.1, 0.1)};
  return {JointRange{},  // the root turns freely
          hip,
          Mirrored(hip),
          spine,
          knee,
          Mirrored(knee),
          spine,
          ankle,
          Mirrored(ankle),
          spine,
          foot,
          Mirrored(foot),
          neck,
          collar,
          Mirrored(collar),
          neck,
          shoulder,
          Mirrored(shoulder),
          elbow,
          Mirrored(elbow),
          wrist,
          Mirrored(wrist),
          hand,
          Mirrored(hand)};
}

}  // namespace

void Describe(OptionTable* table, PriorOptions* o) {
  table->Add(
      "smoothness",
      &o->smoothness,
      {.doc = "weight of the second differences in time", .at_least = 0});
  table->Add("turn",
             &o->turn,
             {.doc = "usual second difference of a joint's rotation",
              .unit = "rad",
              .above = 0});
  table->Add("shift",
             &o->shift,
             {.doc = "usual second difference of the translation",
              .unit = "m",
              .above = 0});
  table->Add("shape",
             &o->shape,
             {.doc = "weight of the shape's own distribution", .at_least = 0});
  table->Add(
      "pose",
      &o->pose,
      {.doc = "weight of the joints' limits and usual range", .at_least = 0});
  table->Add("overlap",
             &o->overlap,
             {.doc = "weight of body parts in each other; 0: not looked at",
              .at_least = 0});
  table->Add("depth",
             &o->depth,
             {.doc = "overlap that counts as one standard deviation",
              .unit = "m",
              .above = 0});
}

RotationLaplacian LaplacianOfRotations(const PoseVector& before,
                                       const PoseVector& here,
                                       const PoseVector& after) {
  RotationLaplacian result;
  for (int j = 0; j < kNumJoints; ++j) {
    const Vector3d theta[3] = {before.segment<3>(3 * j),
                               here.segment<3>(3 * j),
                               after.segment<3>(3 * j)};
    Matrix3d r[3], left[3];
    for (int f = 0; f < 3; ++f) {
      r[f] = Exp(theta[f]);
      left[f] = LeftJacobian(theta[f]);
      result.derivative[f][j].setZero();
    }
    // e = Log(A^T B); a turn w of B adds A^T w, one of A takes it away.
    Vector3d e[2];
    for (int k = 0; k < 2; ++k) {
      e[k] = Log(r[k].transpose() * r[k + 1]);
      const Matrix3d turn = LeftJacobian(e[k]).inverse() * r[k].transpose();
      const double sign = k == 0 ? -1 : 1;
      result.derivative[k + 1][j] += sign * turn * left[k + 1];
      result.derivative[k][j] -= sign * turn * left[k];
    }
    result.value.segment<3>(3 * j) = e[1] - e[0];
  }
  return result;
}

PosePriorVector PosePrior(const PoseVector& pose, PosePriorVector* slope) {
  static const std::array<JointRange, kNumJoints> ranges = MakeRanges();
  PosePriorVector value;
  for (int i = 0; i < kNumPose - 3; ++i) {
    const double angle = pose[3 + i];
    const JointRange& range = ranges[1 + i / 3];
    const int c = i % 3;
    const double over = std::max(0.0, angle - range.high[c]);
    const double under = std::max(0.0, range.low[c] - angle);
    value[2 * i] = (over - under) / kLimitSpread;
    value[2 * i + 1] = (angle - range.usual[c]) / range.spread[c];
    if (!slope) continue;
    (*slope)[2 * i] = over > 0 || under > 0 ? 1 / kLimitSpread : 0;
    (*slope)[2 * i + 1] = 1 / range.spread[c];
  }
  return value;
}

}  // namespace invsim
