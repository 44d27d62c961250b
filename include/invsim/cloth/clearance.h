// SPDX-License-Identifier: Apache-2.0
#ifndef INVSIM_CLOTH_CLEARANCE_H_
#define INVSIM_CLOTH_CLEARANCE_H_

// Keeping a garment off the skin.

#include "invsim/base/types.h"
#include "invsim/geometry/surface_index.h"

namespace invsim {

// How far a cloth surface keeps from a closed body, metres; negative inside.
struct Clearance {
  double vertices = 0.0;  // the least signed distance of a cloth vertex
  // The least signed distance of a sampled point of a face: its vertices, the
  // middles of its sides, its centroid.
  double faces = 0.0;
};
Clearance MeasureClearance(const Points& cloth,
                           const Faces& faces,
                           const SurfaceIndex& body);

// Moves cloth vertices, as little as it takes, until every one is at least
// `vertex_clearance` outside the body and every sampled point of a face at
// least `face_clearance`; a face's lack is shared among its vertices by their
// weights at the point. Neighbours follow a moved vertex in part, so that
// cloth stays smooth. Returns the clearance reached, which falls short of the
// wish where the room itself does (between the thighs, in an armpit).
Clearance PushClear(const Faces& faces,
                    const SurfaceIndex& body,
                    double vertex_clearance,
                    double face_clearance,
                    Points* cloth);

}  // namespace invsim

#endif  // INVSIM_CLOTH_CLEARANCE_H_
