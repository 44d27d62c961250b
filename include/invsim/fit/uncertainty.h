// SPDX-License-Identifier: Apache-2.0
#ifndef INVSIM_FIT_UNCERTAINTY_H_
#define INVSIM_FIT_UNCERTAINTY_H_

// How well the points determine the unknowns: the posterior covariance
//
//   C = (J^T J)^-1
//
// of the linearised problem at the solution (ceres::Covariance), data and
// priors together. It is as true as the noise model of the data term
// (`noise` and `observations`), and knows nothing of an error of the model,
// such as a wrong fabric.
//
// What the data leave open keeps the covariance P of the priors alone, in
// which smoothness ties the frames together as it does in C. So the two are
// compared: a direction of the shape, or of a joint's rotation in one frame,
// whose deviation by C is more than `kUndetermined` of that by P is called
// undetermined. Where there is no prior either, P would be infinite; both
// therefore know the little that is always known (kBroad... below), such as
// that no joint is off by more than about half a turn.

#include <string>
#include <vector>

#include "invsim/fit/objective.h"

namespace invsim {

inline constexpr double kUndetermined = 0.7;

// Deviations of what has neither points nor priors.
inline constexpr double kBroadShape = 10;
inline constexpr double kBroadAngle = 3.141592653589793;  // rad
inline constexpr double kBroadPlace = 10;                 // m

struct Uncertainty {
  // Empty if it was found, else why not (no other member is then set).
  std::string failure;

  Eigen::Matrix<double, kNumShape, kNumShape> shape_covariance;
  ShapeVector shape_deviation;
  // Principal directions of the shape's covariance, the least known first:
  // unit columns, and their deviations.
  Eigen::Matrix<double, kNumShape, kNumShape> shape_directions;
  ShapeVector direction_deviation;
  int undetermined_directions = 0;  // so many of the first

  // Per frame.
  std::vector<PoseVector> pose_deviation;       // rad
  std::vector<Vector3d> translation_deviation;  // m
  // Per joint the share of frames in which its rotation has an undetermined
  // direction.
  std::vector<double> undetermined_joints;
  // Per joint, if in most of these frames that is one direction and much the
  // same: its axis, a unit vector in the frame of the joint's parent. Zero:
  // there is no such axis.
  std::vector<Vector3d> undetermined_axes;

  double seconds = 0;  // that finding it took, once x was evaluated
};

// At objective->x(), of which nothing is held.
Uncertainty FindUncertainty(Objective* objective);

}  // namespace invsim

#endif  // INVSIM_FIT_UNCERTAINTY_H_
