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

#include <array>
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

// Number of entries of R(theta) - I that drive the pose blend shapes: the
// rotation matrices of joints 1 to 23, row by row (SMPL eq. 9).
inline constexpr int kNumPoseFeatures = 9 * (kNumJoints - 1);

// One row per vertex coordinate: row 3i + c is coordinate c of vertex i. Rows
// lie together in memory, because derivatives are asked for vertex by vertex.
using VertexRows =
    Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

// The arrays of an SMPL-layout npz.
struct BodyModelData {
  Points v_template;         // 3 x V, metres
  VertexRows shapedirs;      // 3V x 10, metres per unit of beta
  VertexRows posedirs;       // 3V x 207, or empty: none
  MatrixXd joint_regressor;  // 24 x V, rows sum to one
  MatrixXd weights;          // V x 24, rows sum to one, none negative
  std::vector<int> parents;  // 24; -1 for the root, else smaller than the joint
  Faces faces;               // 3 x F
};

class PosedBody;      // a body posed, with its derivatives: below
struct PreparedBody;  // the arrays made ready for posing: private

class BodyModel {
 public:
  // Throws InputError (naming `name`) if the arrays do not fit together, hold
  // non-finite numbers, name vertices that are not there, or if rows that must
  // sum to one miss it by more than 0.01. Smaller misses, as of 32-bit files,
  // are scaled away; posedirs of zeros only are dropped.
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
  std::shared_ptr<const PreparedBody> body_;
};

// The derivatives are written about the world, not about each joint. A change
// of theta_k turns all that hangs on joint k about its place p_k with the
// angular velocity w = R_parent(k) LeftJacobian(theta_k) dtheta_k, so that
//
//   dM_i = w x sum_{j below k} w_ij (y_ij - p_k),  y_ij = vertex i as joint j
//                                                  alone would carry it.
//
// Sums over vertices run in a fixed order: results do not depend on the number
// of threads.
class PosedBody {
 public:
  virtual ~PosedBody() = default;
  virtual const BodyParameters& parameters() const = 0;
  virtual const Points& vertices() const = 0;  // 3 x V
  virtual const Points& joints() const = 0;    // 3 x 24

  // The rows of dM/d(beta, theta, t) of the chosen vertices:
  // (3 n) x 85, row 3k + c is coordinate c of vertices[k].
  virtual MatrixXd Jacobian(std::span<const int> vertices) const = 0;
  // The same of the joints, 72 x 85.
  virtual MatrixXd JointJacobian() const = 0;
  // J u (3 x V) for u in R^85, and J^T w (85) for w (3 x V), all vertices.
  virtual Points Product(const VectorXd& u) const = 0;
  virtual VectorXd TransposedProduct(const Points& w) const = 0;
};

// Reads an SMPL-layout npz:
//
//   v_template (V,3), shapedirs (V,3,10 or more; the first ten are used),
//   posedirs (V,3,207; a missing one is zeros), J_regressor (24,V),
//   weights (V,24), kintree_table (2,24; the root's parent is -1 or 2^32 - 1),
//   f (F,3).
//
// Pickles are refused with the reason and the remedy. Throws InputError.
BodyModel ReadBodyModel(const std::string& path);
// The same of a file's bytes; `path` opens messages.
BodyModel ParseBodyModel(std::string npz, const std::string& path);

// Writes the same layout: 32-bit floats (as SMPL) and unsigned faces, with
// `joint_names` for the reader. posedirs is left out if there are none.
std::string FormatBodyModel(const BodyModel& body);
void WriteBodyModel(const std::string& path, const BodyModel& body);

// pelvis, left_hip, right_hip, spine1, ...: SMPL's order.
extern const std::array<const char*, kNumJoints> kJointNames;

}  // namespace invsim

#endif  // INVSIM_BODY_BODY_MODEL_H_
