// SPDX-License-Identifier: Apache-2.0
#ifndef INVSIM_STUDY_METRICS_H_
#define INVSIM_STUDY_METRICS_H_

// How far an estimate of body and cloth is from the truth. All distances are
// unsquared; a Chamfer distance is the mean of its two directions, and taken
// between vertices and edge midpoints (one midpoint subdivision), so that it
// measures surfaces and not where their vertices lie.
//
// Per frame, in millimetres:
//
//   body_v2v_mean_mm           same vertex of the posed body
//   body_chamfer_l1_mm         posed body to posed body
//   joint_mean_mm              the 24 posed joints
//   cloth_v2v_mean_mm          same vertex of the garment, if it has the same
//                              mesh as the truth's
//   cloth_chamfer_l1_mm        garment to garment
//   combined_chamfer_l1_mm     what can be seen, garment and bare skin, each
//                              side by its own garment (visible_surface.h, rays
//                              of 15 cm from the skin)
//   points_to_surface_mean_mm  measured points to the estimated visible
//                              surface, exactly, to its triangles
//   penetration_max_mm         deepest garment vertex inside the body
//
// and over the sequence:
//
//   body_tpose_v2v_mean_mm     same vertex in the zero pose: shape alone
//   joint_acceleration_error_mean_m_per_s2   |second difference of joints,
//                              estimate - truth| fps^2, mean
//   joint_jerk_mean_m_per_s3   |third difference| fps^3, mean, of the estimate,
//   joint_jerk_truth_mean_m_per_s3           and of the truth
//   penetrating_vertices_share of all garment vertices
//   friction_cone_violation_share   where the estimate has contact forces r:
//                              sum max(0, |r_T| - mu r_N) / sum |r|, normals
//                              those of the nearest skin at the frame's end

#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "invsim/body/motion.h"
#include "invsim/geometry/chamfer.h"
#include "invsim/study/truth.h"

namespace invsim {

// The cloth of one frame as estimated.
struct ClothEstimate {
  Points vertices;              // 3 x N, m
  Points force = Points(3, 0);  // contact force on each, N; none: not known
  // Of a mesh of its own, coarser than the truth's, say; none: the truth's.
  Faces faces = Faces(3, 0);
};

struct Estimate {
  Motion body;
  // The cloth of a frame, or nothing if it was not estimated. May be empty.
  std::function<std::optional<ClothEstimate>(int)> cloth;
  // Coulomb's mu it was made with; NaN: not known.
  double friction = std::numeric_limits<double>::quiet_NaN();
};

// What an estimate is held against.
struct Reference {
  const BodyModel& body;
  Faces cloth_faces;  // none: cloth is not compared
  Truth truth;
  // The measured points of a frame. May be empty.
  std::function<Points(int)> points;
};

// Millimetres; NaN where it cannot be said.
struct FrameMetrics {
  static constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  double body_v2v = kNone;
  double joint = kNone;
  ChamferDistance body_chamfer{kNone, kNone};  // a: estimate, b: truth
  double cloth_v2v = kNone;
  ChamferDistance cloth_chamfer{kNone, kNone};
  ChamferDistance combined_chamfer{kNone, kNone};
  double points_to_surface = kNone;
  double penetration = kNone;
  double penetrating_share = kNone;
  // Sums over vertices, N.
  double cone_excess = kNone;
  double contact_force = kNone;
};

struct Metrics {
  std::vector<FrameMetrics> frames;
  double body_tpose_v2v = FrameMetrics::kNone;      // mm
  double acceleration_error = FrameMetrics::kNone;  // m/s^2
  double jerk = FrameMetrics::kNone;                // m/s^3
  double jerk_truth = FrameMetrics::kNone;          // m/s^3

  // The keys above (of Chamfer distances also both directions), means over the
  // frames that have the number, of penetration the largest. What cannot be
  // said is left out.
  std::vector<std::pair<std::string, double>> Values() const;
};

// Calls `on_frame` after each frame. Throws InputError if estimate and
// reference do not fit: other frames, other vertices.
Metrics Evaluate(const Reference& reference,
                 const Estimate& estimate,
                 const std::function<void(int)>& on_frame = {});

// Sum max(0, |r_T| - mu r_N) and sum |r| over vertices (N), normals being
// those of the surface's nearest points.
struct ConeViolation {
  double excess = 0;
  double force = 0;
};
ConeViolation MeasureConeViolation(const SurfaceIndex& body,
                                   const ClothEstimate& cloth,
                                   double friction);

}  // namespace invsim

#endif  // INVSIM_STUDY_METRICS_H_
