// SPDX-License-Identifier: Apache-2.0
#include "invsim/geometry/closest_point.h"

#include <Eigen/Geometry>
#include <algorithm>

namespace invsim {
namespace {

// The height of a triangle over its longest side below which it has no face.
constexpr double kFlat = 1e-10;

ClosestPoint OnSides(const Vector3d& q, const Vector3d corners[3]) {
  ClosestPoint best{};
  for (int c = 0; c < 3; ++c) {
    const int from = (c + 1) % 3, to = (c + 2) % 3;
    const double t = ClosestPointOnSegment(q, corners[from], corners[to]);
    Vector3d point = corners[from] + t * (corners[to] - corners[from]);
    auto feature = static_cast<TriangleFeature>(3 + c);
    if (t == 0.0) feature = static_cast<TriangleFeature>(from);
    if (t == 1.0) {
      feature = static_cast<TriangleFeature>(to);
      point = corners[to];
    }
    const double squared = (q - point).squaredNorm();
    if (c > 0 && squared >= best.squared_distance) continue;
    best.point = point;
    best.weights.setZero();
    best.weights[from] = 1.0 - t;
    best.weights[to] = t;
    best.feature = feature;
    best.squared_distance = squared;
  }
  return best;
}

}  // namespace

double ClosestPointOnSegment(const Vector3d& q,
                             const Vector3d& a,
                             const Vector3d& b) {
  const Vector3d ab = b - a;
  const double along = (q - a).dot(ab), squared = ab.squaredNorm();
  if (!(along > 0.0)) return 0.0;
  return along >= squared ? 1.0 : along / squared;
}

ClosestPoint ClosestPointOnTriangle(const Vector3d& q,
                                    const Vector3d& a,
                                    const Vector3d& b,
                                    const Vector3d& c) {
  const Vector3d ab = b - a, ac = c - a, aq = q - a;
  const Vector3d n = ab.cross(ac);
  const double nn = n.squaredNorm();
  const double longest =
      std::max({ab.squaredNorm(), ac.squaredNorm(), (c - b).squaredNorm()});
  if (nn > kFlat * kFlat * longest * longest) {
    const double w1 = n.dot(aq.cross(ac)) / nn;
    const double w2 = n.dot(ab.cross(aq)) / nn;
    const double w0 = 1.0 - w1 - w2;
    if (w0 > 0.0 && w1 > 0.0 && w2 > 0.0) {
      ClosestPoint r;
      r.point = a + w1 * ab + w2 * ac;
      r.weights = Vector3d(w0, w1, w2);
      r.feature = TriangleFeature::kFace;
      r.squared_distance = (q - r.point).squaredNorm();
      return r;
    }
  }
  const Vector3d corners[3] = {a, b, c};
  return OnSides(q, corners);
}

}  // namespace invsim
