// SPDX-License-Identifier: Apache-2.0
#ifndef INVSIM_SIM_PENETRATION_H_
#define INVSIM_SIM_PENETRATION_H_

#include "invsim/geometry/surface_index.h"

namespace invsim {

// How deep cloth vertices are inside the body.
//
// A posed body's skin may cross itself: the upper arm sinks into the chest,
// the thighs into each other. Cloth caught there has nowhere to go; it is
// inside whatever a simulator does, by as much as the body overlaps itself.
// Vertices in such places (where the skin winds round them more than once) are
// the body model's fault, not the simulation's, and counted apart.
struct Penetration {
  double deepest = 0;          // m from the skin, of the vertices inside
  int inside = 0;              // how many they are
  double deepest_overlap = 0;  // the same of vertices where skin crosses skin
  int overlap = 0;

  void KeepWorst(const Penetration& other);
};

Penetration MeasurePenetration(const SurfaceIndex& body, const Points& x);

}  // namespace invsim

#endif  // INVSIM_SIM_PENETRATION_H_
