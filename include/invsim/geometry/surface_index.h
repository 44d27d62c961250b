// SPDX-License-Identifier: Apache-2.0
#ifndef INVSIM_GEOMETRY_SURFACE_INDEX_H_
#define INVSIM_GEOMETRY_SURFACE_INDEX_H_

// Distance and ray queries against a triangle mesh that moves: faces are given
// once, positions are refreshed whenever the body has moved.
//
// A bounding volume hierarchy over single-precision copies of the faces only
// says which faces come into question; every number handed out is computed
// from the double-precision positions. A nearest point is therefore exact, and
// among faces at equal distance the one of the smallest number is taken, so
// that results do not depend on the order of the search or on threads.
//
// Queries may run concurrently with each other, not with `Update`.

#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "invsim/base/types.h"
#include "invsim/geometry/closest_point.h"

namespace invsim {

// A point on a face of the surface.
struct FacePoint {
  int face = -1;
  TriangleFeature feature = TriangleFeature::kFace;
  Vector3d weights = Vector3d::Zero();  // barycentric, of the face's corners
  Vector3d point = Vector3d::Zero();    // metres
  double distance = 0.0;                // to the query, metres, >= 0
};

// The nearest point of the surface.
struct SurfacePoint : FacePoint {
  // Unit pseudo-normal of the feature the point lies on: the face's normal,
  // the sum of the two faces' at an edge, the angle-weighted sum at a vertex.
  // On a closed surface its side is the query's side, whatever the feature
  // (Baerentzen & Aanaes, Signed distance computation using the angle weighted
  // pseudonormal, 2005).
  Vector3d normal = Vector3d::Zero();
  // +distance outside, -distance inside.
  double signed_distance = 0.0;
};

struct RayHit {
  int face = -1;
  Vector3d weights = Vector3d::Zero();
  double distance = 0.0;  // along the unit direction, metres
};

class SurfaceIndex {
 public:
  // Throws InputError if the faces are not a consistently oriented manifold
  // (see Edges) or refer to a vertex that does not exist.
  SurfaceIndex(const Points& vertices, const Faces& faces);
  ~SurfaceIndex();
  SurfaceIndex(SurfaceIndex&&) noexcept;
  SurfaceIndex& operator=(SurfaceIndex&&) noexcept;

  // New positions of the same vertices.
  void Update(const Points& vertices);

  const Points& vertices() const;
  const Faces& faces() const;

  SurfacePoint Nearest(const Vector3d& query) const;
  // As above, or nothing if the surface is farther than `radius`.
  std::optional<SurfacePoint> NearestWithin(const Vector3d& query,
                                            double radius) const;
  // One result per column, threaded.
  std::vector<SurfacePoint> NearestAll(const Points& queries) const;

  // Every face with a point within `radius`, with its closest point, by
  // ascending face number. Replaces the contents of `found`.
  void Within(const Vector3d& query,
              double radius,
              std::vector<FacePoint>* found) const;

  // First hit from `origin` along `direction` (any length but zero), faces hit
  // from either side, at distances in [0, max_distance].
  std::optional<RayHit> FirstHit(const Vector3d& origin,
                                 const Vector3d& direction,
                                 double max_distance) const;
  bool AnyHit(const Vector3d& origin,
              const Vector3d& direction,
              double max_distance) const;

  // How often the closed surface winds round the point: 0 outside, 1 inside,
  // 2 where two of its parts overlap, as in a bent joint. The median of the
  // signed crossings of three rays.
  int WindingNumber(const Vector3d& query) const;
  // Whether it is positive: unlike the sign of the distance this stays right
  // where the surface crosses itself.
  bool Contains(const Vector3d& query) const {
    return WindingNumber(query) > 0;
  }

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace invsim

#endif  // INVSIM_GEOMETRY_SURFACE_INDEX_H_
