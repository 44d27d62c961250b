// SPDX-License-Identifier: Apache-2.0
#include "invsim/body/body_model.h"

#include <utility>

#include "prepared_body.h"

namespace invsim {
namespace {

void CollectInfluences(PreparedBody* body) {
  const MatrixXd& weights = body->data.weights;
  body->first.push_back(0);
  for (Eigen::Index i = 0; i < weights.rows(); ++i) {
    for (int j = 0; j < kNumJoints; ++j) {
      if (weights(i, j) != 0.0) body->influences.push_back({j, weights(i, j)});
    }
    body->first.push_back(static_cast<int>(body->influences.size()));
  }
}

void RegressJoints(PreparedBody* body) {
  const BodyModelData& data = body->data;
  body->rest_joints.noalias() =
      data.v_template * data.joint_regressor.transpose();
  for (int j = 0; j < kNumJoints; ++j) {
    body->joint_shape[j].setZero();
    for (int i = 0; i < body->num_vertices(); ++i) {
      const double r = data.joint_regressor(j, i);
      if (r == 0.0) continue;
      body->joint_shape[j] += r * data.shapedirs.middleRows<3>(3 * i);
    }
  }
}

}  // namespace

BodyModel::BodyModel(BodyModelData data, const std::string& name) {
  auto body = std::make_shared<PreparedBody>();
  body->data = CheckBodyModelData(std::move(data), name);
  CollectInfluences(body.get());
  RegressJoints(body.get());
  body_ = std::move(body);
}

int BodyModel::num_vertices() const { return body_->num_vertices(); }
const Faces& BodyModel::faces() const { return body_->data.faces; }
const BodyModelData& BodyModel::data() const { return body_->data; }

Points BodyModel::Vertices(const BodyParameters& p) const {
  return Pose(p)->vertices();
}

Points BodyModel::Joints(const BodyParameters& p) const {
  return Pose(p)->joints();
}

std::shared_ptr<const PosedBody> BodyModel::Pose(
    const BodyParameters& p) const {
  return MakePosedBody(body_, p);
}

}  // namespace invsim
