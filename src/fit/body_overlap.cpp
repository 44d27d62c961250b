// SPDX-License-Identifier: Apache-2.0
#include "invsim/fit/body_overlap.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace invsim {
namespace {

// Pairs nearer than this in the T-pose are not asked to part.
constexpr double kClear = 0.02;  // m

double Clamp01(double s) { return std::clamp(s, 0.0, 1.0); }

double ToSegment(const Vector3d& p, const Vector3d& a, const Vector3d& b) {
  const Vector3d d = b - a;
  const double s = Clamp01((p - a).dot(d) / std::max(d.squaredNorm(), 1e-12));
  return (p - a - s * d).norm();
}

double Median(std::vector<double>* values) {
  const auto middle = values->begin() + values->size() / 2;
  std::nth_element(values->begin(), middle, values->end());
  return *middle;
}

}  // namespace

// The unconstrained minimum of a quadratic in two shares, then moved onto the
// square edge by edge.
SegmentShares NearestOfSegments(const Vector3d& a0,
                                const Vector3d& a1,
                                const Vector3d& b0,
                                const Vector3d& b1) {
  const Vector3d u = a1 - a0, v = b1 - b0, w = a0 - b0;
  const double uu = std::max(u.squaredNorm(), 1e-12);
  const double vv = std::max(v.squaredNorm(), 1e-12);
  const double uv = u.dot(v), uw = u.dot(w), vw = v.dot(w);
  const double det = uu * vv - uv * uv;
  double s = det > 1e-12 * uu * vv ? Clamp01((uv * vw - vv * uw) / det) : 0;
  const double t = Clamp01((uv * s + vw) / vv);
  s = Clamp01((uv * t - uw) / uu);
  return {s, Clamp01((uv * s + vw) / vv)};
}

BodyOverlap::BodyOverlap(const BodyModel& body) {
  const Points vertices = body.Vertices({});
  const Points joints = body.Joints({});
  const std::vector<int>& parents = body.data().parents;
  std::vector<std::vector<double>> distances(kNumJoints);
  for (int i = 0; i < vertices.cols(); ++i) {
    int owner = 0;
    body.data().weights.row(i).maxCoeff(&owner);
    int nearest = -1;
    double least = std::numeric_limits<double>::infinity();
    for (int j = 1; j < kNumJoints; ++j) {
      if (parents[j] != owner) continue;
      const double d =
          ToSegment(vertices.col(i), joints.col(owner), joints.col(j));
      if (d < least) {
        least = d;
        nearest = j;
      }
    }
    if (nearest >= 0) distances[nearest].push_back(least);
  }
  for (int j = 1; j < kNumJoints; ++j)
    if (!distances[j].empty())
      bones_.push_back({parents[j], j, Median(&distances[j])});
  for (int a = 0; a < static_cast<int>(bones_.size()); ++a)
    for (int b = a + 1; b < static_cast<int>(bones_.size()); ++b) {
      pairs_.push_back({a, b});
      const Bone &p = bones_[a], &q = bones_[b];
      const SegmentShares s = NearestOfSegments(joints.col(p.from),
                                                joints.col(p.to),
                                                joints.col(q.from),
                                                joints.col(q.to));
      const Vector3d apart =
          (1 - s.a) * joints.col(p.from) + s.a * joints.col(p.to) -
          (1 - s.b) * joints.col(q.from) - s.b * joints.col(q.to);
      if (apart.norm() < p.radius + q.radius + kClear) pairs_.pop_back();
    }
}

VectorXd BodyOverlap::Depths(const Points& joints,
                             VertexRows* by_joints) const {
  const int n = static_cast<int>(pairs_.size());
  VectorXd depths = VectorXd::Zero(n);
  if (by_joints) by_joints->setZero(n, 3 * kNumJoints);
  for (int k = 0; k < n; ++k) {
    const Bone &p = bones_[pairs_[k].a], &q = bones_[pairs_[k].b];
    const SegmentShares s = NearestOfSegments(joints.col(p.from),
                                              joints.col(p.to),
                                              joints.col(q.from),
                                              joints.col(q.to));
    const int joint[4] = {p.from, p.to, q.from, q.to};
    const double share[4] = {1 - s.a, s.a, s.b - 1, -s.b};
    Vector3d apart = Vector3d::Zero();
    for (int i = 0; i < 4; ++i) apart += share[i] * joints.col(joint[i]);
    const double distance = apart.norm();
    const double depth = p.radius + q.radius - distance;
    if (depth <= 0) continue;
    depths[k] = depth;
    if (!by_joints || distance < 1e-9) continue;
    // The shares are at a minimum: they do not count.
    for (int i = 0; i < 4; ++i)
      by_joints->block<1, 3>(k, 3 * joint[i]) -=
          share[i] / distance * apart.transpose();
  }
  return depths;
}

}  // namespace invsim
