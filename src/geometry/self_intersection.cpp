// SPDX-License-Identifier: Apache-2.0
#include "invsim/geometry/self_intersection.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "invsim/base/threads.h"
#include "invsim/geometry/surface_index.h"

namespace invsim {
namespace {

// How far off the plane of a triangle a segment may be, relative to its length
// or distance, to lie in it but for rounding.
constexpr double kInPlane = 1e-12;

// Whether a side of face f without vertices of g meets g.
bool SideMeets(const Points& x, const Faces& faces, int f, int g) {
  const auto shared = [&](int v) { return (faces.col(g).array() == v).any(); };
  for (int c = 0; c < 3; ++c) {
    const int p = faces(c, f), q = faces((c + 1) % 3, f);
    if (shared(p) || shared(q)) continue;
    if (SegmentMeetsTriangle(x.col(p),
                             x.col(q),
                             x.col(faces(0, g)),
                             x.col(faces(1, g)),
                             x.col(faces(2, g))))
      return true;
  }
  return false;
}

}  // namespace

bool SegmentMeetsTriangle(const Vector3d& p,
                          const Vector3d& q,
                          const Vector3d& a,
                          const Vector3d& b,
                          const Vector3d& c) {
  // The signed volumes of (p, a, b, c) and (q, a, b, c) tell the sides of the
  // ends, those of (p, q) with each side whether the line passes within.
  const Vector3d n = (b - a).cross(c - a);
  const double from = n.dot(p - a), to = n.dot(q - a);
  if ((from > 0.0) == (to > 0.0)) return false;
  const Vector3d d = q - p;
  if (std::max(std::abs(from), std::abs(to)) <=
      kInPlane * n.norm() * std::max(d.norm(), (p - a).norm()))
    return false;
  const double ab = d.dot((a - p).cross(b - p));
  const double bc = d.dot((b - p).cross(c - p));
  const double ca = d.dot((c - p).cross(a - p));
  return (ab >= 0.0 && bc >= 0.0 && ca >= 0.0) ||
         (ab <= 0.0 && bc <= 0.0 && ca <= 0.0);
}

bool FacesCross(const Points& vertices, const Faces& faces, int f, int g) {
  return SideMeets(vertices, faces, f, g) || SideMeets(vertices, faces, g, f);
}

std::vector<std::array<int, 2>> SelfIntersections(const Points& vertices,
                                                  const Faces& faces) {
  const SurfaceIndex index(vertices, faces);
  const auto count = static_cast<int>(faces.cols());
  std::vector<std::vector<int>> partners(count);
  ParallelFor(count, 16, [&](int f) {
    Vector3d centre = Vector3d::Zero();
    for (int c = 0; c < 3; ++c) centre += vertices.col(faces(c, f)) / 3.0;
    double radius = 0.0;
    for (int c = 0; c < 3; ++c)
      radius = std::max(radius, (vertices.col(faces(c, f)) - centre).norm());
    std::vector<FacePoint> near;
    index.Within(centre, radius, &near);
    for (const FacePoint& p : near)
      if (p.face > f && FacesCross(vertices, faces, f, p.face))
        partners[f].push_back(p.face);
  });
  std::vector<std::array<int, 2>> pairs;
  for (int f = 0; f < count; ++f)
    for (const int g : partners[f]) pairs.push_back({f, g});
  return pairs;
}

}  // namespace invsim
