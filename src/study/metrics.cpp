// SPDX-License-Identifier: Apache-2.0
#include "invsim/study/metrics.h"

#include <algorithm>
#include <cmath>

#include "invsim/base/error.h"
#include "invsim/geometry/subdivision.h"
#include "invsim/study/visible_surface.h"

namespace invsim {
namespace {

constexpr double kMillimetresPerMetre = 1000;
// From the skin itself: what is measured here is the covered, not contact.
constexpr CoverRay kRay = {.inside = 0, .reach = kCoverRay};

double MeanDistance(const Points& a, const Points& b) {
  return kMillimetresPerMetre * (a - b).colwise().norm().mean();
}

ChamferDistance SurfaceChamfer(const TriangleMesh& a, const TriangleMesh& b) {
  const ChamferDistance metres = Chamfer(SubdivideMidpoint(a).mesh.vertices,
                                         SubdivideMidpoint(b).mesh.vertices);
  return {kMillimetresPerMetre * metres.a_to_b,
          kMillimetresPerMetre * metres.b_to_a};
}

// Mean norm of the differences of the given order times fps^order.
double MeanDifference(std::vector<Points> joints, int order, double fps) {
  for (int k = 0; k < order; ++k) {
    if (joints.size() < 2) return FrameMetrics::kNone;
    for (size_t t = 0; t + 1 < joints.size(); ++t)
      joints[t] = (joints[t + 1] - joints[t]) * fps;
    joints.pop_back();
  }
  if (joints.empty()) return FrameMetrics::kNone;
  double sum = 0;
  for (const Points& j : joints) sum += j.colwise().norm().mean();
  return sum / static_cast<double>(joints.size());
}

void CheckFits(const Reference& reference, const Estimate& estimate) {
  const int wanted = reference.truth.body.num_frames();
  const int have = estimate.body.num_frames();
  if (have != wanted)
    throw InputError("the run has " + std::to_string(have) +
                     " frames, expected " + std::to_string(wanted) +
                     " as the truth has");
}

void MeasurePenetration(const SurfaceIndex& body,
                        const Points& cloth,
                        FrameMetrics* m) {
  int inside = 0;
  double deepest = 0;
  for (const SurfacePoint& p : body.NearestAll(cloth)) {
    inside += p.signed_distance < 0;
    deepest = std::max(deepest, -p.signed_distance);
  }
  m->penetration = kMillimetresPerMetre * deepest;
  m->penetrating_share = inside / static_cast<double>(cloth.cols());
}

// Everything about the cloth of frame t. The bodies are posed.
void CompareCloth(const Reference& reference,
                  const ClothEstimate& cloth,
                  int t,
                  double friction,
                  const TriangleMesh& body,
                  const TriangleMesh& true_body,
                  FrameMetrics* m) {
  const Points& truth = reference.truth.cloth[t];
  const Faces& true_faces = reference.cloth_faces;
  const bool own_mesh = cloth.faces.cols() > 0 && cloth.faces != true_faces;
  const Faces& faces = own_mesh ? cloth.faces : true_faces;
  if (!own_mesh && cloth.vertices.cols() != truth.cols())
    throw InputError("frame " + std::to_string(t) + ": the run's cloth has " +
                     std::to_string(cloth.vertices.cols()) +
                     " vertices, expected " + std::to_string(truth.cols()) +
                     " as the truth has");
  if (!own_mesh) m->cloth_v2v = MeanDistance(cloth.vertices, truth);
  m->cloth_chamfer =
      SurfaceChamfer({cloth.vertices, faces}, {truth, true_faces});
  const TriangleMesh seen =
      FindVisibleSurface(body, SurfaceIndex(cloth.vertices, faces), kRay).mesh;
  m->combined_chamfer = SurfaceChamfer(
      seen,
      FindVisibleSurface(true_body, SurfaceIndex(truth, true_faces), kRay)
          .mesh);
  if (reference.points)
    m->points_to_surface =
        kMillimetresPerMetre *
        DistancesToSurface(reference.points(t),
                           SurfaceIndex(seen.vertices, seen.faces))
            .mean();
  const SurfaceIndex skin(body.vertices, body.faces);
  MeasurePenetration(skin, cloth.vertices, m);
  if (cloth.force.cols() == 0 || std::isnan(friction)) return;
  const ConeViolation cone = MeasureConeViolation(skin, cloth, friction);
  m->cone_excess = cone.excess;
  m->contact_force = cone.force;
}

// Mean over the frames that have it; NaN if none has.
template <typename Value>
double Mean(const std::vector<FrameMetrics>& frames, const Value& value) {
  double sum = 0;
  int count = 0;
  for (const FrameMetrics& f : frames) {
    const double v = value(f);
    if (std::isnan(v)) continue;
    sum += v;
    ++count;
  }
  return count > 0 ? sum / count : FrameMetrics::kNone;
}

class ValueList {
 public:
  explicit ValueList(const std::vector<FrameMetrics>& frames)
      : frames_(frames) {}

  void Add(const std::string& key, double value) {
    if (!std::isnan(value)) values_.emplace_back(key, value);
  }
  void AddMean(const std::string& key, double FrameMetrics::*member) {
    Add(key, Mean(frames_, [&](const FrameMetrics& f) { return f.*member; }));
  }
  void AddChamfer(const std::string& what,
                  ChamferDistance FrameMetrics::*member) {
    const auto mean = [&](const auto& part) {
      return Mean(frames_,
                  [&](const FrameMetrics& f) { return part(f.*member); });
    };
    Add(what + "_chamfer_l1_mm",
        mean([](const ChamferDistance& c) { return c.mean(); }));
    Add(what + "_chamfer_estimate_to_truth_mm",
        mean([](const ChamferDistance& c) { return c.a_to_b; }));
    Add(what + "_chamfer_truth_to_estimate_mm",
        mean([](const ChamferDistance& c) { return c.b_to_a; }));
  }
  std::vector<std::pair<std::string, double>> Take() {
    return std::move(values_);
  }

 private:
  const std::vector<FrameMetrics>& frames_;
  std::vector<std::pair<std::string, double>> values_;
};

}  // namespace

ConeViolation MeasureConeViolation(const SurfaceIndex& body,
                                   const ClothEstimate& cloth,
                                   double friction) {
  ConeViolation v;
  for (int i = 0; i < cloth.vertices.cols(); ++i) {
    const Vector3d r = cloth.force.col(i);
    if (r.isZero()) continue;
    const Vector3d n = body.Nearest(cloth.vertices.col(i)).normal;
    const double normal = r.dot(n);
    const double tangential = (r - normal * n).norm();
    v.excess += std::max(0.0, tangential - friction * normal);
    v.force += r.norm();
  }
  return v;
}

std::vector<std::pair<std::string, double>> Metrics::Values() const {
  ValueList list(frames);
  list.AddMean("body_v2v_mean_mm", &FrameMetrics::body_v2v);
  list.Add("body_tpose_v2v_mean_mm", body_tpose_v2v);
  list.AddMean("joint_mean_mm", &FrameMetrics::joint);
  list.AddChamfer("body", &FrameMetrics::body_chamfer);
  list.AddMean("cloth_v2v_mean_mm", &FrameMetrics::cloth_v2v);
  list.AddChamfer("cloth", &FrameMetrics::cloth_chamfer);
  list.AddChamfer("combined", &FrameMetrics::combined_chamfer);
  list.AddMean("points_to_surface_mean_mm", &FrameMetrics::points_to_surface);
  double deepest = FrameMetrics::kNone, excess = 0, force = 0;
  for (const FrameMetrics& f : frames) {
    deepest = std::fmax(deepest, f.penetration);
    if (std::isnan(f.cone_excess)) continue;
    excess += f.cone_excess;
    force += f.contact_force;
  }
  list.Add("penetration_max_mm", deepest);
  list.AddMean("penetrating_vertices_share", &FrameMetrics::penetrating_share);
  list.Add("joint_acceleration_error_mean_m_per_s2", acceleration_error);
  list.Add("joint_jerk_mean_m_per_s3", jerk);
  list.Add("joint_jerk_truth_mean_m_per_s3", jerk_truth);
  if (force > 0) list.Add("friction_cone_violation_share", excess / force);
  return list.Take();
}

Metrics Evaluate(const Reference& reference,
                 const Estimate& estimate,
                 const std::function<void(int)>& on_frame) {
  CheckFits(reference, estimate);
  const BodyModel& body = reference.body;
  const Motion& truth = reference.truth.body;
  const bool has_cloth = estimate.cloth && reference.cloth_faces.cols() > 0 &&
                         !reference.truth.cloth.empty();
  Metrics metrics;
  std::vector<Points> joints, true_joints, difference;
  for (int t = 0; t < truth.num_frames(); ++t) {
    FrameMetrics m;
    const auto posed = body.Pose(estimate.body.Frame(t));
    const auto true_posed = body.Pose(truth.Frame(t));
    const TriangleMesh skin{posed->vertices(), body.faces()};
    const TriangleMesh true_skin{true_posed->vertices(), body.faces()};
    m.body_v2v = MeanDistance(skin.vertices, true_skin.vertices);
    m.joint = MeanDistance(posed->joints(), true_posed->joints());
    m.body_chamfer = SurfaceChamfer(skin, true_skin);
    joints.push_back(posed->joints());
    true_joints.push_back(true_posed->joints());
    difference.push_back(joints.back() - true_joints.back());
    if (has_cloth) {
      const std::optional<ClothEstimate> cloth = estimate.cloth(t);
      if (cloth)
        CompareCloth(
            reference, *cloth, t, estimate.friction, skin, true_skin, &m);
    }
    metrics.frames.push_back(m);
    if (on_frame) on_frame(t);
  }
  BodyParameters t_pose, true_t_pose;
  t_pose.shape = estimate.body.shape;
  true_t_pose.shape = truth.shape;
  metrics.body_tpose_v2v =
      MeanDistance(body.Vertices(t_pose), body.Vertices(true_t_pose));
  const double fps = truth.frame_rate;
  metrics.acceleration_error = MeanDifference(std::move(difference), 2, fps);
  metrics.jerk = MeanDifference(std::move(joints), 3, fps);
  metrics.jerk_truth = MeanDifference(std::move(true_joints), 3, fps);
  return metrics;
}

}  // namespace invsim
