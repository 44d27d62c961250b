// SPDX-License-Identifier: Apache-2.0
#include "invsim/fit/uncertainty.h"

#include <ceres/covariance.h>
#include <ceres/normal_prior.h>
#include <ceres/problem.h>

#include <Eigen/Eigenvalues>
#include <cmath>
#include <optional>

#include "invsim/base/stopwatch.h"
#include "invsim/base/threads.h"
#include "invsim/body/rotation.h"

namespace invsim {
namespace {

// An axis is one and the same if so much of it lies along the mean one.
constexpr double kSameAxis = 0.8;

using ShapeMatrix = Eigen::Matrix<double, kNumShape, kNumShape>;

// Blocks of a covariance, each of an unknown with itself.
struct Covariances {
  ShapeMatrix shape;
  std::vector<Eigen::Matrix<double, kNumPose, kNumPose>> poses;
  std::vector<Matrix3d> translations;
};

// What is known without points and priors, while it lives.
class BroadPrior {
 public:
  BroadPrior(ceres::Problem* problem, const BodySequence& x)
      : problem_(problem) {
    Add(x.shape, kBroadShape);
    for (const PoseVector& pose : x.poses) Add(pose, kBroadAngle);
    for (const Vector3d& place : x.translations) Add(place, kBroadPlace);
  }
  ~BroadPrior() {
    for (const ceres::ResidualBlockId block : blocks_)
      problem_->RemoveResidualBlock(block);
  }
  BroadPrior(const BroadPrior&) = delete;
  BroadPrior& operator=(const BroadPrior&) = delete;

 private:
  template <typename Vector>
  void Add(const Vector& value, double deviation) {
    const auto n = value.size();
    blocks_.push_back(problem_->AddResidualBlock(
        new ceres::NormalPrior(MatrixXd::Identity(n, n) / deviation, value),
        nullptr,
        const_cast<double*>(value.data())));
  }

  ceres::Problem* problem_;
  std::vector<ceres::ResidualBlockId> blocks_;
};

template <typename Matrix>
Matrix BlockOf(const ceres::Covariance& covariance, const double* block) {
  Eigen::Matrix<double,
                Matrix::RowsAtCompileTime,
                Matrix::ColsAtCompileTime,
                Eigen::RowMajor>
      c;
  covariance.GetCovarianceBlock(block, block, c.data());
  return c;
}

// Nothing if some unknown is not determined at all.
std::optional<Covariances> FindCovariances(Objective* objective) {
  const BodySequence& x = *objective->x();
  const BroadPrior broad(objective->problem(), x);
  std::vector<std::pair<const double*, const double*>> wanted;
  const auto want = [&](const double* block) {
    wanted.push_back({block, block});
  };
  want(x.shape.data());
  for (const PoseVector& pose : x.poses) want(pose.data());
  for (const Vector3d& place : x.translations) want(place.data());
  ceres::Covariance::Options options;
  options.algorithm_type = ceres::SPARSE_QR;
  options.num_threads = NumThreads();
  ceres::Covariance covariance(options);
  if (!covariance.Compute(wanted, objective->problem())) return std::nullopt;
  Covariances found;
  found.shape = BlockOf<ShapeMatrix>(covariance, x.shape.data());
  for (const PoseVector& pose : x.poses)
    found.poses.push_back(BlockOf<Eigen::Matrix<double, kNumPose, kNumPose>>(
        covariance, pose.data()));
  for (const Vector3d& place : x.translations)
    found.translations.push_back(BlockOf<Matrix3d>(covariance, place.data()));
  return found;
}

void Deviations(const Covariances& c, Uncertainty* u) {
  const auto deviation = [](const auto& covariance) {
    return covariance.diagonal().cwiseMax(0).cwiseSqrt();
  };
  u->shape_covariance = c.shape;
  u->shape_deviation = deviation(c.shape);
  for (const auto& pose : c.poses) u->pose_deviation.push_back(deviation(pose));
  for (const Matrix3d& place : c.translations)
    u->translation_deviation.push_back(deviation(place));
}

void ShapeDirections(const ShapeMatrix& prior, Uncertainty* u) {
  const Eigen::SelfAdjointEigenSolver<ShapeMatrix> eigen(u->shape_covariance);
  u->shape_directions = eigen.eigenvectors().rowwise().reverse();
  u->direction_deviation =
      eigen.eigenvalues().reverse().cwiseMax(0).cwiseSqrt();
  for (int k = 0; k < kNumShape; ++k) {
    const ShapeVector direction = u->shape_directions.col(k);
    const double before = std::sqrt(direction.dot(prior * direction));
    if (u->direction_deviation[k] > kUndetermined * before)
      u->undetermined_directions = k + 1;
  }
}

// Directions of a rotation in which the data left `posterior` much as `prior`
// was: eigenvectors of C P^-1 (unit columns), whose values are the shares of
// the variance that are left.
Eigen::Matrix3Xd OpenDirections(const Matrix3d& posterior,
                                const Matrix3d& prior) {
  const Eigen::GeneralizedSelfAdjointEigenSolver<Matrix3d> eigen(posterior,
                                                                 prior);
  Eigen::Matrix3Xd open(3, 0);
  for (int k = 0; k < 3; ++k) {
    if (!(eigen.eigenvalues()[k] > kUndetermined * kUndetermined)) continue;
    open.conservativeResize(3, open.cols() + 1);
    // (C - l P) u = 0 for u = P^-1 d.
    open.rightCols(1) = (prior * eigen.eigenvectors().col(k)).normalized();
  }
  return open;
}

// The axis of most of the `open` frames, if there is one.
Vector3d CommonAxis(const std::vector<Vector3d>& axes, int open) {
  Matrix3d sum = Matrix3d::Zero();
  for (const Vector3d& axis : axes) sum += axis * axis.transpose();
  const Eigen::SelfAdjointEigenSolver<Matrix3d> eigen(sum);
  if (open == 0 || eigen.eigenvalues()[2] < kSameAxis * open)
    return Vector3d::Zero();
  const Vector3d axis = eigen.eigenvectors().col(2);
  int largest = 0;
  axis.cwiseAbs().maxCoeff(&largest);
  return axis[largest] < 0 ? Vector3d(-axis) : axis;
}

void UndeterminedJoints(const Covariances& posterior,
                        const Covariances& prior,
                        const BodySequence& x,
                        Uncertainty* u) {
  for (int j = 0; j < kNumJoints; ++j) {
    int open = 0;
    std::vector<Vector3d> single;
    for (int t = 0; t < x.num_frames(); ++t) {
      const Eigen::Matrix3Xd directions =
          OpenDirections(posterior.poses[t].block<3, 3>(3 * j, 3 * j),
                         prior.poses[t].block<3, 3>(3 * j, 3 * j));
      if (directions.cols() > 0) ++open;
      // From a change of the axis-angle vector to the axis that it turns about.
      if (directions.cols() == 1)
        single.push_back((LeftJacobian(Vector3d(x.poses[t].segment<3>(3 * j))) *
                          directions.col(0))
                             .normalized());
    }
    u->undetermined_joints.push_back(static_cast<double>(open) /
                                     x.num_frames());
    u->undetermined_axes.push_back(CommonAxis(single, open));
  }
}

}  // namespace

Uncertainty FindUncertainty(Objective* objective) {
  Uncertainty u;
  double cost = 0;
  std::vector<double> gradient;
  if (!objective->Evaluate(&cost, &gradient)) {
    u.failure = "the cost has no derivative at the solution";
    return u;
  }
  const Stopwatch watch;
  const auto posterior = FindCovariances(objective);
  const auto prior = FindCovariances(objective->WithoutData().get());
  if (!posterior || !prior) {
    u.failure = "the covariance could not be computed";
    return u;
  }
  Deviations(*posterior, &u);
  ShapeDirections(prior->shape, &u);
  UndeterminedJoints(*posterior, *prior, *objective->x(), &u);
  u.seconds = watch.seconds();
  return u;
}

}  // namespace invsim
