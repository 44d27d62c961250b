// SPDX-License-Identifier: Apache-2.0
#ifndef INVSIM_SRC_BODY_PREPARED_BODY_H_
#define INVSIM_SRC_BODY_PREPARED_BODY_H_

// The arrays of a body model checked and made ready for posing: shared by
// body_model.cpp, which makes them, and posed_body.cpp, which skins with them.

#include <array>
#include <memory>
#include <string>
#include <vector>

#include "invsim/body/body_model.h"

namespace invsim {

struct Influence {
  int joint;
  double weight;
};

using JointPlaces = Eigen::Matrix<double, 3, kNumJoints>;
using JointShape = Eigen::Matrix<double, 3, kNumShape>;

struct PreparedBody {
  BodyModelData data;
  // The non-zero weights of vertex i: influences[first[i] .. first[i + 1]).
  std::vector<int> first;
  std::vector<Influence> influences;
  // J(beta) = rest_joints + joint_shape beta.
  JointPlaces rest_joints;
  std::array<JointShape, kNumJoints> joint_shape;

  int num_vertices() const { return static_cast<int>(data.v_template.cols()); }
  bool has_posedirs() const { return data.posedirs.rows() > 0; }
};

// Throws InputError naming `name` if the arrays are unfit; scales rows that
// must sum to one and drops posedirs of zeros.
BodyModelData CheckBodyModelData(BodyModelData data, const std::string& name);

std::shared_ptr<const PosedBody> MakePosedBody(
    std::shared_ptr<const PreparedBody> body, const BodyParameters& p);

}  // namespace invsim

#endif  // INVSIM_SRC_BODY_PREPARED_BODY_H_
