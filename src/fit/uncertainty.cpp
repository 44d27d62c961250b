// SPDX-License-Identifier: Apache-2.0
#include "invsim/fit/uncertainty.h"

#include <ceres/covariance.h>
#include <ceres/problem.h>

#include <Eigen/Eigenvalues>
#include <cmath>

#include "invsim/base/threads.h"

namespace invsim {
namespace {

using PoseCovariance =
    Eigen::Matrix<double, kNumPose, kNumPose, Eigen::RowMajor>;
using ShapeCovariance =
    Eigen::Matrix<double, kNumShape, kNumShape, Eigen::RowMajor>;

std::vector<std::pair<const double*, const double*>> Diagonal(
    const BodySequence& x) {
  std::vector<std::pair<const double*, const double*>> blocks;
  const auto add = [&](const double* block) {
    blocks.push_back({block, block});
  };
  add(x.shape.data());
  for (const PoseVector& pose : x.poses) add(pose.data());
  for (const Vector3d& translation : x.translations) add(translation.data());
  return blocks;
}

void ShapeDirections(const PriorOptions& priors, Uncertainty* u) {
  const Eigen::SelfAdjointEigenSolver<
      Eigen::Matrix<double, kNumShape, kNumShape>>
      eigen(u->shape_covariance);
  u->shape_directions = eigen.eigenvectors().rowwise().reverse();
  u->direction_deviation =
      eigen.eigenvalues().reverse().cwiseMax(0).cwiseSqrt();
  const double prior = priors.shape > 0
                           ? 1 / std::sqrt(priors.shape)
                           : std::numeric_limits<double>::infinity();
  for (int k = 0; k < kNumShape; ++k)
    if (u->direction_deviation[k] > kUndetermined * prior)
      u->undetermined_directions = k + 1;
}

void UndeterminedJoints(const PriorOptions& priors, Uncertainty* u) {
  u->undetermined_joints.assign(kNumJoints, 0);
  if (!(priors.pose > 0)) return;
  PosePriorVector slope;
  PosePrior(PoseVector::Zero(), &slope);
  const double share = 1.0 / (3 * u->pose_deviation.size());
  for (int i = 3; i < kNumPose; ++i) {
    // The row of the usual range: standard deviations per radian.
    const double prior = 1 / (slope[2 * (i - 3) + 1] * std::sqrt(priors.pose));
    for (const PoseVector& deviation : u->pose_deviation)
      if (deviation[i] > kUndetermined * prior)
        u->undetermined_joints[i / 3] += share;
  }
}

}  // namespace

Uncertainty FindUncertainty(const PriorOptions& priors, Objective* objective) {
  Uncertainty u;
  const BodySequence& x = *objective->x();
  double cost = 0;
  std::vector<double> gradient;
  if (!objective->Evaluate(&cost, &gradient)) {
    u.failure = "the cost has no derivative at the solution";
    return u;
  }
  ceres::Covariance::Options options;
  options.algorithm_type = ceres::SPARSE_QR;
  options.num_threads = NumThreads();
  ceres::Covariance covariance(options);
  if (!covariance.Compute(Diagonal(x), objective->problem())) {
    u.failure =
        "the covariance could not be computed: without priors some unknowns "
        "are not determined at all";
    return u;
  }
  ShapeCovariance shape;
  covariance.GetCovarianceBlock(x.shape.data(), x.shape.data(), shape.data());
  u.shape_covariance = shape;
  u.shape_deviation = shape.diagonal().cwiseSqrt();
  for (const PoseVector& pose : x.poses) {
    PoseCovariance c;
    covariance.GetCovarianceBlock(pose.data(), pose.data(), c.data());
    u.pose_deviation.push_back(c.diagonal().cwiseMax(0).cwiseSqrt());
  }
  for (const Vector3d& translation : x.translations) {
    Eigen::Matrix<double, 3, 3, Eigen::RowMajor> c;
    covariance.GetCovarianceBlock(
        translation.data(), translation.data(), c.data());
    u.translation_deviation.push_back(c.diagonal().cwiseMax(0).cwiseSqrt());
  }
  ShapeDirections(priors, &u);
  UndeterminedJoints(priors, &u);
  return u;
}

}  // namespace invsim
