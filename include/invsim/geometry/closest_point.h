// SPDX-License-Identifier: Apache-2.0
#ifndef INVSIM_GEOMETRY_CLOSEST_POINT_H_
#define INVSIM_GEOMETRY_CLOSEST_POINT_H_

// The point of a segment or of a triangle that is closest to a query point,
// and on which part (vertex, edge, face) it lies: the part decides the normal
// and the derivative of the distance.

#include "invsim/base/types.h"

namespace invsim {

// A part of the triangle (0, 1, 2). Edge c is opposite vertex c.
enum class TriangleFeature {
  kVertex0,
  kVertex1,
  kVertex2,
  kEdge0,
  kEdge1,
  kEdge2,
  kFace
};

constexpr bool IsVertex(TriangleFeature f) {
  return f <= TriangleFeature::kVertex2;
}
constexpr bool IsEdge(TriangleFeature f) {
  return !IsVertex(f) && f != TriangleFeature::kFace;
}
// The number of the vertex, or of the vertex opposite the edge.
constexpr int FeatureCorner(TriangleFeature f) {
  return static_cast<int>(f) % 3;
}

struct ClosestPoint {
  Vector3d point;
  Vector3d weights;  // barycentric, >= 0, sum 1; exactly 0 off the feature
  TriangleFeature feature;
  double squared_distance;  // m^2
};

// q = query. The projection of q on the plane has the weights
//   w_1 = n . ((q - a) x (c - a)) / n.n,  w_2 = n . ((b - a) x (q - a)) / n.n,
// n = (b - a) x (c - a). If all three are positive the face is closest,
// otherwise the nearest of the three sides is. A triangle whose height is
// below 1e-10 of its longest side is treated as its three sides, so that no
// weight is ever a quotient of rounding errors; vertices may coincide.
ClosestPoint ClosestPointOnTriangle(const Vector3d& q,
                                    const Vector3d& a,
                                    const Vector3d& b,
                                    const Vector3d& c);

// The parameter t in [0, 1] of the closest point a + t (b - a); 0 if a == b.
double ClosestPointOnSegment(const Vector3d& q,
                             const Vector3d& a,
                             const Vector3d& b);

}  // namespace invsim

#endif  // INVSIM_GEOMETRY_CLOSEST_POINT_H_
