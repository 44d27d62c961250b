// SPDX-License-Identifier: Apache-2.0

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <utility>

#include "invsim/base/threads.h"
#include "invsim/body/rotation.h"
#include "prepared_body.h"

namespace invsim {
namespace {

constexpr int kPoseColumn = kNumShape;
constexpr int kTranslationColumn = kNumShape + kNumPose;
// Vertices go to the threads, and into sums, in blocks of this many.
constexpr int kBlock = 256;

using PoseFeatures = Eigen::Matrix<double, kNumPoseFeatures, 1>;
using FeatureRows = Eigen::Matrix<double, 3, kNumPoseFeatures, Eigen::RowMajor>;
// d(R - I, row by row)/d theta of one joint.
using FeatureDerivative = Eigen::Matrix<double, 9, 3>;
using VertexJacobian = Eigen::Matrix<double, 3, kNumBodyParameters>;

// What the pull-back J^T w gathers from a block of vertices.
struct Pull {
  JointPlaces force = JointPlaces::Zero();    // sum_i w_ij f_i
  std::array<Matrix3d, kNumJoints> moment{};  // sum_i w_ij f_i T_i^T
  ShapeVector shape = ShapeVector::Zero();    // sum_i S_i^T A_i^T f_i
  PoseFeatures features = PoseFeatures::Zero();
  Vector3d total = Vector3d::Zero();

  Pull() { moment.fill(Matrix3d::Zero()); }
  void Add(const Pull& other) {
    force += other.force;
    for (int j = 0; j < kNumJoints; ++j) moment[j] += other.moment[j];
    shape += other.shape;
    features += other.features;
    total += other.total;
  }
};

Eigen::Matrix<double, 9, 1> RowByRow(const Matrix3d& m) {
  Eigen::Matrix<double, 9, 1> v;
  v << m(0, 0), m(0, 1), m(0, 2), m(1, 0), m(1, 1), m(1, 2), m(2, 0), m(2, 1),
      m(2, 2);
  return v;
}

template <typename Function>
void ForBlocks(int count, const Function& function) {
  ParallelForPieces(count, kBlock, [&](int begin, int end) {
    function(begin / kBlock, begin, end);
  });
}

class SkinnedBody : public PosedBody {
 public:
  SkinnedBody(std::shared_ptr<const PreparedBody> body, const BodyParameters& p)
      : body_(std::move(body)), parameters_(p) {
    PoseJoints();
    if (body_->has_posedirs()) PoseBlendShapes();
    Skin();
  }

  const BodyParameters& parameters() const override { return parameters_; }
  const Points& vertices() const override { return vertices_; }
  const Points& joints() const override { return joints_; }

  MatrixXd Jacobian(std::span<const int> vertices) const override;
  MatrixXd JointJacobian() const override;
  Points Product(const VectorXd& u) const override;
  VectorXd TransposedProduct(const Points& w) const override;

 private:
  void PoseJoints();
  void PoseBlendShapes();
  void Skin();

  int parent(int j) const { return body_->data.parents[j]; }
  Vector3d pose(int j) const { return parameters_.pose.segment<3>(3 * j); }
  std::span<const Influence> Influences(int i) const {
    return std::span(body_->influences)
        .subspan(body_->first[i], body_->first[i + 1] - body_->first[i]);
  }
  auto ShapeRows(int i) const {
    return body_->data.shapedirs.middleRows<3>(3 * i);
  }
  auto PoseRows(int i) const {
    return body_->data.posedirs.middleRows<3>(3 * i);
  }
  // A_i = sum_j w_ij R_j: what skinning does to a change of T_i.
  Matrix3d BlendedRotation(int i) const;
  // T_i as joint j alone would carry it, without the translation.
  Vector3d Carried(int i, int j) const {
    return rotation_[j] * (unposed_.col(i) - rest_joints_.col(j)) +
           places_.col(j);
  }
  VertexJacobian JacobianOf(int i) const;
  void PullBlock(const Points& w, int begin, int end, Pull* pull) const;
  VectorXd PullToParameters(const Pull& pull) const;

  std::shared_ptr<const PreparedBody> body_;
  BodyParameters parameters_;
  JointPlaces rest_joints_;  // J(beta)
  JointPlaces places_;       // of the posed joints, without the translation
  std::array<Matrix3d, kNumJoints> rotation_;  // R_j, in the world
  // The world's angular velocity of joint j per unit of its theta.
  std::array<Matrix3d, kNumJoints> turning_;
  std::array<JointShape, kNumJoints> place_shape_;  // d places / d beta
  std::array<FeatureDerivative, kNumJoints> feature_derivative_;
  Points unposed_;  // T(beta, theta)
  Points vertices_;
  Points joints_;
};

void SkinnedBody::PoseJoints() {
  for (int j = 0; j < kNumJoints; ++j) {
    const JointShape& shape = body_->joint_shape[j];
    rest_joints_.col(j) = body_->rest_joints.col(j) + shape * parameters_.shape;
    if (j == 0) {
      rotation_[j] = Exp(pose(j));
      turning_[j] = LeftJacobian(pose(j));
      places_.col(j) = rest_joints_.col(j);
      place_shape_[j] = shape;
      continue;
    }
    const int a = parent(j);
    rotation_[j] = rotation_[a] * Exp(pose(j));
    turning_[j] = rotation_[a] * LeftJacobian(pose(j));
    places_.col(j) = places_.col(a) +
                     rotation_[a] * (rest_joints_.col(j) - rest_joints_.col(a));
    place_shape_[j] =
        place_shape_[a] + rotation_[a] * (shape - body_->joint_shape[a]);
  }
  joints_ = places_.colwise() + parameters_.translation;
  unposed_ = body_->data.v_template;
  Eigen::Map<VectorXd>(unposed_.data(), unposed_.size()).noalias() +=
      body_->data.shapedirs * parameters_.shape;
}

void SkinnedBody::PoseBlendShapes() {
  PoseFeatures features;
  for (int j = 1; j < kNumJoints; ++j) {
    features.segment<9>(9 * (j - 1)) =
        RowByRow(Exp(pose(j)) - Matrix3d::Identity());
    const std::array<Matrix3d, 3> d = ExpDerivatives(pose(j));
    for (int c = 0; c < 3; ++c) feature_derivative_[j].col(c) = RowByRow(d[c]);
  }
  ForBlocks(body_->num_vertices(), [&](int, int begin, int end) {
    for (int i = begin; i < end; ++i) unposed_.col(i) += PoseRows(i) * features;
  });
}

void SkinnedBody::Skin() {
  vertices_.resize(3, body_->num_vertices());
  ForBlocks(body_->num_vertices(), [&](int, int begin, int end) {
    for (int i = begin; i < end; ++i) {
      Vector3d sum = parameters_.translation;
      for (const auto& [j, weight] : Influences(i)) {
        sum += weight * Carried(i, j);
      }
      vertices_.col(i) = sum;
    }
  });
}

Matrix3d SkinnedBody::BlendedRotation(int i) const {
  Matrix3d sum = Matrix3d::Zero();
  for (const auto& [j, weight] : Influences(i)) sum += weight * rotation_[j];
  return sum;
}

VertexJacobian SkinnedBody::JacobianOf(int i) const {
  VertexJacobian jacobian = VertexJacobian::Zero();
  const Matrix3d blended = BlendedRotation(i);
  auto shape = jacobian.leftCols<kNumShape>();
  shape.noalias() = blended * ShapeRows(i);
  // Weight and weighted place of all that hangs on each joint.
  std::array<double, kNumJoints> below{};
  JointPlaces carried = JointPlaces::Zero();
  for (const auto& [j, weight] : Influences(i)) {
    shape += weight * (place_shape_[j] - rotation_[j] * body_->joint_shape[j]);
    const Vector3d place = weight * Carried(i, j);
    for (int k = j; k >= 0; k = parent(k)) {
      below[k] += weight;
      carried.col(k) += place;
    }
  }
  for (int k = 0; k < kNumJoints; ++k) {
    if (below[k] == 0.0) continue;
    const Vector3d arm = carried.col(k) - below[k] * places_.col(k);
    for (int c = 0; c < 3; ++c) {
      jacobian.col(kPoseColumn + 3 * k + c) = turning_[k].col(c).cross(arm);
    }
  }
  if (body_->has_posedirs()) {
    const FeatureRows rows = blended * PoseRows(i);
    for (int k = 1; k < kNumJoints; ++k) {
      jacobian.middleCols<3>(kPoseColumn + 3 * k).noalias() +=
          rows.middleCols<9>(9 * (k - 1)) * feature_derivative_[k];
    }
  }
  jacobian.rightCols<3>().setIdentity();
  return jacobian;
}

MatrixXd SkinnedBody::Jacobian(std::span<const int> vertices) const {
  MatrixXd rows(3 * vertices.size(), kNumBodyParameters);
  ForBlocks(static_cast<int>(vertices.size()), [&](int, int begin, int end) {
    for (int k = begin; k < end; ++k) {
      rows.middleRows<3>(3 * k) = JacobianOf(vertices[k]);
    }
  });
  return rows;
}

MatrixXd SkinnedBody::JointJacobian() const {
  MatrixXd rows = MatrixXd::Zero(3 * kNumJoints, kNumBodyParameters);
  for (int j = 0; j < kNumJoints; ++j) {
    auto block = rows.middleRows<3>(3 * j);
    block.leftCols<kNumShape>() = place_shape_[j];
    for (int k = parent(j); k >= 0; k = parent(k)) {
      const Vector3d arm = places_.col(j) - places_.col(k);
      for (int c = 0; c < 3; ++c) {
        block.col(kPoseColumn + 3 * k + c) = turning_[k].col(c).cross(arm);
      }
    }
    block.rightCols<3>().setIdentity();
  }
  return rows;
}

// A change of the parameters gives every joint an angular velocity and a
// velocity, hence an affine map of T_i.
Points SkinnedBody::Product(const VectorXd& u) const {
  const ShapeVector shape = u.head<kNumShape>();
  const Vector3d translation = u.tail<3>();
  JointPlaces angular;
  JointPlaces velocity;
  std::array<Matrix3d, kNumJoints> linear;
  JointPlaces offset;
  for (int j = 0; j < kNumJoints; ++j) {
    const int a = parent(j);
    angular.col(j) = turning_[j] * u.segment<3>(kPoseColumn + 3 * j);
    velocity.col(j) = place_shape_[j] * shape;
    for (int k = a; k >= 0; k = parent(k)) {
      velocity.col(j) += (turning_[k] * u.segment<3>(kPoseColumn + 3 * k))
                             .cross(places_.col(j) - places_.col(k));
    }
    if (a >= 0) angular.col(j) += angular.col(a);
    linear[j] = Cross(angular.col(j)) * rotation_[j];
    offset.col(j) = velocity.col(j) - linear[j] * rest_joints_.col(j) -
                    rotation_[j] * (body_->joint_shape[j] * shape);
  }
  PoseFeatures features = PoseFeatures::Zero();
  for (int k = 1; body_->has_posedirs() && k < kNumJoints; ++k) {
    features.segment<9>(9 * (k - 1)) =
        feature_derivative_[k] * u.segment<3>(kPoseColumn + 3 * k);
  }
  Points change(3, body_->num_vertices());
  ForBlocks(body_->num_vertices(), [&](int, int begin, int end) {
    for (int i = begin; i < end; ++i) {
      Vector3d unposed = ShapeRows(i) * shape;
      if (body_->has_posedirs()) unposed += PoseRows(i) * features;
      Vector3d sum = translation;
      for (const auto& [j, weight] : Influences(i)) {
        sum += weight * (linear[j] * unposed_.col(i) + offset.col(j) +
                         rotation_[j] * unposed);
      }
      change.col(i) = sum;
    }
  });
  return change;
}

void SkinnedBody::PullBlock(const Points& w,
                            int begin,
                            int end,
                            Pull* pull) const {
  for (int i = begin; i < end; ++i) {
    const Vector3d f = w.col(i);
    const Matrix3d f_t = f * unposed_.col(i).transpose();
    for (const auto& [j, weight] : Influences(i)) {
      pull->force.col(j) += weight * f;
      pull->moment[j] += weight * f_t;
    }
    const Vector3d unposed = BlendedRotation(i).transpose() * f;
    pull->shape.noalias() += ShapeRows(i).transpose() * unposed;
    if (body_->has_posedirs()) {
      pull->features.noalias() += PoseRows(i).transpose() * unposed;
    }
    pull->total += f;
  }
}

// As forces on a tree of rigid links: each joint hands its force and its
// torque down to its parent.
VectorXd SkinnedBody::PullToParameters(const Pull& pull) const {
  VectorXd gradient(kNumBodyParameters);
  ShapeVector shape = pull.shape;
  JointPlaces force = pull.force;
  JointPlaces torque;
  for (int j = 0; j < kNumJoints; ++j) {
    const Matrix3d n =
        (pull.moment[j] - pull.force.col(j) * rest_joints_.col(j).transpose()) *
        rotation_[j].transpose();
    torque.col(j) << n(2, 1) - n(1, 2), n(0, 2) - n(2, 0), n(1, 0) - n(0, 1);
    shape +=
        (place_shape_[j] - rotation_[j] * body_->joint_shape[j]).transpose() *
        pull.force.col(j);
  }
  for (int j = kNumJoints - 1; j >= 0; --j) {
    gradient.segment<3>(kPoseColumn + 3 * j) =
        turning_[j].transpose() * torque.col(j);
    if (j == 0) break;
    const int a = parent(j);
    const Vector3d arm = places_.col(j) - places_.col(a);
    torque.col(a) += torque.col(j) + arm.cross(Vector3d(force.col(j)));
    force.col(a) += force.col(j);
    if (body_->has_posedirs()) {
      gradient.segment<3>(kPoseColumn + 3 * j) +=
          feature_derivative_[j].transpose() *
          pull.features.segment<9>(9 * (j - 1));
    }
  }
  gradient.head<kNumShape>() = shape;
  gradient.segment<3>(kTranslationColumn) = pull.total;
  return gradient;
}

VectorXd SkinnedBody::TransposedProduct(const Points& w) const {
  const int n = body_->num_vertices();
  std::vector<Pull> pulls((n + kBlock - 1) / kBlock);
  ForBlocks(n, [&](int block, int begin, int end) {
    PullBlock(w, begin, end, &pulls[block]);
  });
  Pull sum;
  for (const Pull& pull : pulls) sum.Add(pull);
  return PullToParameters(sum);
}

}  // namespace

std::shared_ptr<const PosedBody> MakePosedBody(
    std::shared_ptr<const PreparedBody> body, const BodyParameters& p) {
  return std::make_shared<SkinnedBody>(std::move(body), p);
}

}  // namespace invsim
