// SPDX-License-Identifier: Apache-2.0
#ifndef INVSIM_CLOTH_AUTHORED_GARMENT_H_
#define INVSIM_CLOTH_AUTHORED_GARMENT_H_

// Garments made to measure round any body with the 24 joints of SMPL, standing
// in the T-pose: nothing needs to be downloaded to dress a body.
//
// A garment is the surface of a solid, cut open. The solid is the union of the
// body grown by the ease and of hanging tubes (see SectionTube) round trunk,
// arms or legs, so that the cloth follows shoulders and hips but spans hollows;
// it is sampled on a grid as a signed distance, smoothed, and polygonised. Cuts
// (see ConeCut) at neck, hem, cuffs, armholes, waist and ankles open it; it is
// then remeshed to triangles of the wanted edge length and pushed clear of the
// skin.
//
// Rest shape: each triangle as it is placed, so the garment is sewn to fit,
// without stretch. Hinges are flat at rest: woven or knitted cloth keeps no
// memory of the form it was cut round, and is bent at rest only by its seams.

#include <string>
#include <vector>

#include "invsim/base/types.h"
#include "invsim/cloth/garment.h"
#include "invsim/cloth/tpose_body.h"

namespace invsim {

struct AuthoredGarmentOptions {
  double edge_length = 0.02;  // metres; 0.008 to 0.08
  // Least distance from the skin aimed at, metres; 0.004 to 0.03. Tubes are
  // wider by what the cut of the garment wants.
  double ease = 0.01;
};

// "tshirt", "long_sleeved_shirt", "tank_top", "dress", "trousers".
const std::vector<std::string>& AuthoredGarmentNames();

// Vertices are 3 mm or more clear of the skin, faces 2 mm. Throws UsageError
// for an unknown name or an option out of range, and InputError if the body is
// not one as described or leaves no room for the garment.
Garment AuthoredGarment(const std::string& name,
                        const TPoseBody& body,
                        const AuthoredGarmentOptions& options = {});

}  // namespace invsim

#endif  // INVSIM_CLOTH_AUTHORED_GARMENT_H_
