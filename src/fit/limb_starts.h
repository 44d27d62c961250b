// SPDX-License-Identifier: Apache-2.0
#ifndef INVSIM_SRC_FIT_LIMB_STARTS_H_
#define INVSIM_SRC_FIT_LIMB_STARTS_H_

// Poses in which single limbs are tried again. A first fit of a whole body
// loses limbs where they lie close together: arms folded before the chest,
// legs side by side. Both then fit the points of one, or each those of the
// other, and no small step leads away from that.

#include <vector>

#include "invsim/body/body_model.h"

namespace invsim {

struct LimbStart {
  struct Turn {
    int joint;
    Vector3d rotation;  // axis-angle, in the SMPL layout's frame
  };
  std::vector<Turn> turns;

  BodyParameters From(const BodyParameters& body) const;
};

struct Limb {
  std::vector<int> joints;  // those that move when it is tried
  std::vector<LimbStart> starts;
};

// Both arms at once, each arm (out, down, forward, up, before the belly; with
// three bends of the elbow); both legs, in either stride, with the pelvis, each
// leg (straight, spread, in two strides, lifted with the knee bent).
std::vector<Limb> Limbs();

}  // namespace invsim

#endif  // INVSIM_SRC_FIT_LIMB_STARTS_H_
