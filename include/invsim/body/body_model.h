// SPDX-License-Identifier: Apache-2.0
#ifndef INVSIM_BODY_BODY_MODEL_H_
#define INVSIM_BODY_BODY_MODEL_H_

// An SMPL-format body M(beta, theta, t): linear blend skinning of a template
// with shape and pose blend shapes (Loper et al., SMPL, 2015, eqs. 2-10).
//
//   T(beta, theta) = template + S beta + P (R(theta) - I)
//   J(beta)        = Jr (template + S beta)
//   M_i            = sum_j w_ij (G_j(theta, J) - G_j rest) T_i + t
//
// theta holds 24 axis-angle joint rotations relative to the parent, the first
// the root's, which turns about the pelvis joint (the SMPL convention).

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "invsim/base/types.h"

namespace invsim {

inline constexpr int kNumJoints = 24;
inline constexpr int kNumShape = 10;
inline constexpr int kNumPose = 3 * kNumJoints;
// beta, theta, t in this order: the columns of every Jacobian.
inline constexpr int kNumBodyParameters = kNumShape + kNumPose + 3;

using ShapeVector = Eigen::Matrix<double, kNumShape, 1>;
using PoseVector = Eigen::Matrix<double, kNumPose, 1>;

struct BodyParameters {
  ShapeVector shape = ShapeVector::Zero();
  PoseVector pose = PoseVector::Zero();  // radians
  Vector3d translation = Vector3d::Zero();
};

// The arrays of an SMPL-layout npz, as read.
struct BodyModelData {
  Points v_template;        // 3 x V
  MatrixXd shapedirs;       // 3V x 10; row 3i+c: coordinate c of vertex i
  MatrixXd posedirs;        // 3V x 207, or empty: none
  MatrixXd joint_regressor; // 24 x V, rows sum to one
  MatrixXd weights;         // V x 24, rows sum to one
  std::vector<int> parents; // 24; -1 for the root
  Faces faces;              // 3 x F
};

// A body posed, with what its derivatives need. Cheap to copy by pointer.
class PosedBody;

class BodyModel {
 public:
  // Throws InputError (naming `name`) if the arrays do not fit together.
  explicit BodyModel(BodyModelData data, const std::string& name = "body");

  int num_vertices() const;
  const Faces& faces() const;
  const BodyModelData& data() const;

  // Vertices (3 x V) and joints (3 x 24) at the given parameters.
  Points Vertices(const BodyParameters& p) const;
  Points Joints(const BodyParameters& p) const;

  // Poses the body and keeps what the derivatives need.
  std::shared_ptr<const PosedBody> Pose(const BodyParameters& p) const;

 private:
  struct Impl;
  std::shared_ptr<const Impl> impl_;
  friend class PosedBody;
};

class PosedBody {
 public:
  virtual ~PosedBody() = default;
  virtual const BodyParameters& parameters() const = 0;
  virtual const Points& vertices() const = 0;  // 3 x V
  virtual const Points& joints() const = 0;    // 3 x 24

  // The rows of dM/d(beta, theta, t) of the chosen vertices:
  // (3 n) x 85, row 3k + c is coordinate c of vertices[k].
  virtual MatrixXd Jacobian(std::span<const int> vertices) const = 0;
  // Joint Jacobian, 72 x 85.
  virtual MatrixXd JointJacobian() const = 0;
  // J u (3 x V) for u in R^85, and J^T w (85) for w (3 x V), all vertices.
  virtual Points Product(const VectorXd& u) const = 0;
  virtual VectorXd TransposedProduct(const Points& w) const = 0;
};

// Reads an SMPL-layout npz (v_template, shapedirs, posedirs, J_regressor,
// weights, kintree_table, f). A missing posedirs is zeros; pickled arrays are
// refused with the reason and the remedy. Throws InputError.
BodyModel ReadBodyModel(const std::string& path);

}  // namespace invsim

#endif  // INVSIM_BODY_BODY_MODEL_H_
