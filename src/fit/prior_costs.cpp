// SPDX-License-Identifier: Apache-2.0
#include "prior_costs.h"

#include <ceres/sized_cost_function.h>

namespace invsim {
namespace {

template <int Rows, int Columns>
using RowMajor = Eigen::Matrix<double, Rows, Columns, Eigen::RowMajor>;

class RotationSmoothness
    : public ceres::SizedCostFunction<kNumPose, kNumPose, kNumPose, kNumPose> {
 public:
  explicit RotationSmoothness(double scale) : scale_(scale) {}
  bool Evaluate(double const* const* x,
                double* residuals,
                double** jacobians) const override {
    using Map = Eigen::Map<const PoseVector>;
    const RotationLaplacian laplacian =
        LaplacianOfRotations(Map(x[0]), Map(x[1]), Map(x[2]));
    Eigen::Map<PoseVector>(residuals, kNumPose) = scale_ * laplacian.value;
    for (int f = 0; jacobians && f < 3; ++f) {
      if (!jacobians[f]) continue;
      Eigen::Map<RowMajor<kNumPose, kNumPose>> j(jacobians[f]);
      j.setZero();
      for (int k = 0; k < kNumJoints; ++k)
        j.block<3, 3>(3 * k, 3 * k) = scale_ * laplacian.derivative[f][k];
    }
    return true;
  }

 private:
  double scale_;
};

class TranslationSmoothness : public ceres::SizedCostFunction<3, 3, 3, 3> {
 public:
  explicit TranslationSmoothness(double scale) : scale_(scale) {}
  bool Evaluate(double const* const* x,
                double* residuals,
                double** jacobians) const override {
    constexpr double kStencil[3] = {1, -2, 1};
    for (int c = 0; c < 3; ++c)
      residuals[c] = scale_ * (x[0][c] - 2 * x[1][c] + x[2][c]);
    for (int f = 0; jacobians && f < 3; ++f) {
      if (!jacobians[f]) continue;
      Eigen::Map<RowMajor<3, 3>> j(jacobians[f]);
      j = scale_ * kStencil[f] * Matrix3d::Identity();
    }
    return true;
  }

 private:
  double scale_;
};

class ShapePrior : public ceres::SizedCostFunction<kNumShape, kNumShape> {
 public:
  explicit ShapePrior(double scale) : scale_(scale) {}
  bool Evaluate(double const* const* x,
                double* residuals,
                double** jacobians) const override {
    for (int i = 0; i < kNumShape; ++i) residuals[i] = scale_ * x[0][i];
    if (!jacobians || !jacobians[0]) return true;
    Eigen::Map<RowMajor<kNumShape, kNumShape>> j(jacobians[0]);
    j = scale_ * RowMajor<kNumShape, kNumShape>::Identity();
    return true;
  }

 private:
  double scale_;
};

class PosePriorCost : public ceres::SizedCostFunction<kNumPosePrior, kNumPose> {
 public:
  explicit PosePriorCost(double scale) : scale_(scale) {}
  bool Evaluate(double const* const* x,
                double* residuals,
                double** jacobians) const override {
    PosePriorVector slope;
    Eigen::Map<PosePriorVector>(residuals, kNumPosePrior) =
        scale_ * PosePrior(Eigen::Map<const PoseVector>(x[0]), &slope);
    if (!jacobians || !jacobians[0]) return true;
    Eigen::Map<RowMajor<kNumPosePrior, kNumPose>> j(jacobians[0]);
    j.setZero();
    for (int r = 0; r < kNumPosePrior; ++r) j(r, 3 + r / 2) = scale_ * slope[r];
    return true;
  }

 private:
  double scale_;
};

// The place does not matter: parts of a body move together.
class OverlapCost : public ceres::CostFunction {
 public:
  OverlapCost(double scale, const BodyModel* body, const BodyOverlap* overlap)
      : scale_(scale), body_(body), overlap_(overlap) {
    set_num_residuals(static_cast<int>(overlap->pairs().size()));
    *mutable_parameter_block_sizes() = {kNumShape, kNumPose};
  }
  bool Evaluate(double const* const* x,
                double* residuals,
                double** jacobians) const override {
    BodyParameters p;
    p.shape = Eigen::Map<const ShapeVector>(x[0]);
    p.pose = Eigen::Map<const PoseVector>(x[1]);
    const int n = num_residuals();
    if (!jacobians) {
      Eigen::Map<VectorXd>(residuals, n) =
          scale_ * overlap_->Depths(body_->Joints(p), nullptr);
      return true;
    }
    const std::shared_ptr<const PosedBody> posed = body_->Pose(p);
    VertexRows by_joints;
    Eigen::Map<VectorXd>(residuals, n) =
        scale_ * overlap_->Depths(posed->joints(), &by_joints);
    const MatrixXd j = scale_ * by_joints * posed->JointJacobian();
    if (jacobians[0])
      Eigen::Map<VertexRows>(jacobians[0], n, kNumShape) =
          j.leftCols(kNumShape);
    if (jacobians[1])
      Eigen::Map<VertexRows>(jacobians[1], n, kNumPose) =
          j.middleCols(kNumShape, kNumPose);
    return true;
  }

 private:
  double scale_;
  const BodyModel* body_;
  const BodyOverlap* overlap_;
};

}  // namespace

ceres::CostFunction* NewRotationSmoothness(double scale) {
  return new RotationSmoothness(scale);
}
ceres::CostFunction* NewTranslationSmoothness(double scale) {
  return new TranslationSmoothness(scale);
}
ceres::CostFunction* NewShapePrior(double scale) {
  return new ShapePrior(scale);
}
ceres::CostFunction* NewPosePrior(double scale) {
  return new PosePriorCost(scale);
}

ceres::CostFunction* NewOverlapCost(double scale,
                                    const BodyModel* body,
                                    const BodyOverlap* overlap) {
  return new OverlapCost(scale, body, overlap);
}

}  // namespace invsim
