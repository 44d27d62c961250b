// SPDX-License-Identifier: Apache-2.0
#ifndef INVSIM_GEOMETRY_BOX_OVERLAP_H_
#define INVSIM_GEOMETRY_BOX_OVERLAP_H_

// Which axis-aligned boxes of a set overlap each other: the broad phase of a
// search for colliding pairs. It runs on a bounding volume hierarchy (Embree)
// over boxes rounded outwards to single precision; what it returns is decided
// by the boxes given.

#include <array>
#include <vector>

#include "invsim/base/types.h"

namespace invsim {

// Box i is low.col(i) <= x <= high.col(i), metres, finite. Pairs (i < j) whose
// boxes have a point in common, sorted.
std::vector<std::array<int, 2>> OverlappingBoxes(const Points& low,
                                                 const Points& high);

}  // namespace invsim

#endif  // INVSIM_GEOMETRY_BOX_OVERLAP_H_
