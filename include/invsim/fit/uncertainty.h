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
// What the data leave open keeps the deviation of its prior. A direction of
// the shape, or an angle of a joint, whose deviation is more than
// `kUndetermined` of its prior's is named as such.

#include <string>
#include <vector>

#include "invsim/fit/objective.h"

namespace invsim {

inline constexpr double kUndetermined = 0.7;

struct Uncertainty {
  // Empty if it was found, else why not (no other member is then set).
  std::string failure;

  Eigen::Matrix<double, kNumShape, kNumShape> shape_covariance;
  ShapeVector shape_deviation;
  // Principal directions of the shape's covariance, the least known first:
  // unit columns, and their deviations (the prior's is 1 / sqrt(weight)).
  Eigen::Matrix<double, kNumShape, kNumShape> shape_directions;
  ShapeVector direction_deviation;
  int undetermined_directions = 0;  // so many of the first

  // Per frame.
  std::vector<PoseVector> pose_deviation;       // rad
  std::vector<Vector3d> translation_deviation;  // m
  // Per joint the share of frames and angles that are undetermined.
  std::vector<double> undetermined_joints;
};

// At objective->x(). `priors` are those of the objective.
Uncertainty FindUncertainty(const PriorOptions& priors, Objective* objective);

}  // namespace invsim

#endif  // INVSIM_FIT_UNCERTAINTY_H_
